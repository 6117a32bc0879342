// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "tagfield/propagation/internal/beam.h"

namespace tagfield {
namespace {

/// Upper bound on the rounding error in single precision, relative to the terms of the sum.
constexpr double kSingle = 1e-6;

/// Stores the half space n·p + w ≥ 0 [world] relative to the antenna.
void put(const Eigen::Vector4d& plane, const Eigen::Vector3d& p_WA, std::size_t k, int lane,
         BeamBlock& block) {
  const double offset = plane.head<3>().dot(p_WA) + plane.w();
  for (int axis = 0; axis < 3; ++axis) {
    block.normals[k][static_cast<std::size_t>(axis)][lane] = static_cast<float>(plane[axis]);
  }
  block.offsets[k][lane] = static_cast<float>(offset + kSingle * (1.0 + std::abs(offset)));
}

BeamBlock unseen() {
  BeamBlock block;
  for (std::size_t k = 0; k < BeamBlock::kPlanes; ++k) {
    for (BeamBlock::Lanes& axis : block.normals[k]) axis.setZero();
    block.offsets[k].setConstant(-std::numeric_limits<float>::infinity());
  }
  return block;
}

}  // namespace

std::vector<BeamBlock> beam_blocks(const std::vector<Image>& images,
                                   const std::vector<BeamSides>& beams,
                                   const Eigen::Vector3d& p_WA) {
  std::vector<BeamBlock> blocks((images.size() + kBeamLanes - 1) / kBeamLanes, unseen());
  for (std::size_t i = 0; i < images.size(); ++i) {
    BeamBlock& block = blocks[i / kBeamLanes];
    const auto lane = static_cast<int>(i % kBeamLanes);
    Eigen::Vector4d mirror;
    mirror << images[i].normal_W, -images[i].offset_m;
    put(mirror, p_WA, 0, lane, block);
    for (int row = 0; row < 4; ++row) {
      put(beams[i].row(row), p_WA, static_cast<std::size_t>(row) + 1, lane, block);
    }
  }
  return blocks;
}

BeamBlock::Lanes seen_from(const BeamBlock& block, const Eigen::Vector3f& p) {
  BeamBlock::Lanes least = BeamBlock::Lanes::Constant(std::numeric_limits<float>::infinity());
  for (std::size_t k = 0; k < BeamBlock::kPlanes; ++k) {
    const auto& [x, y, z] = block.normals[k];
    least = least.min(x * p.x() + y * p.y() + z * p.z() + block.offsets[k]);
  }
  return least + static_cast<float>(kSingle) * p.lpNorm<1>();
}

}  // namespace tagfield
