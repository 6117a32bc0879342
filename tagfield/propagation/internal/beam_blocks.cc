// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "tagfield/base/single_precision.h"
#include "tagfield/propagation/internal/beam.h"

namespace tagfield {
namespace {

/// Stores the half space n·p + w ≥ 0 [world] relative to the antenna.
void put(const Eigen::Vector4d& plane, const Eigen::Vector3d& p_WA, std::size_t k, std::size_t lane,
         BeamBlock& block) {
  const double offset = plane.head<3>().dot(p_WA) + plane.w();
  for (int axis = 0; axis < 3; ++axis) {
    block.normals[k][static_cast<std::size_t>(axis)][lane] = static_cast<float>(plane[axis]);
  }
  block.offsets[k][lane] = static_cast<float>(offset + kSinglePrecision * (1.0 + std::abs(offset)));
}

BeamBlock unseen() {
  BeamBlock block;
  for (BeamBlock::Lanes& offsets : block.offsets) {
    offsets.fill(-std::numeric_limits<float>::infinity());
  }
  return block;
}

/// Sets `height[i]`, for each lane, to the height of `p` above the lowest of its planes, plus
/// `slack` [m]. Returns 0 if none is ≥ 0. Written for vector instructions.
inline std::int32_t set_heights(const BeamBlock& block, const Eigen::Vector3f& p, float slack,
                                float* height) {
  const float px = p.x();
  const float py = p.y();
  const float pz = p.z();
  const auto* const n = block.normals.data();
  const auto* const w = block.offsets.data();
  std::int32_t any = 0;
#pragma GCC ivdep
  for (std::size_t i = 0; i < kBeamLanes; ++i) {
    const auto above = [&](std::size_t k) {
      return n[k][0][i] * px + n[k][1][i] * py + n[k][2][i] * pz + w[k][i];
    };
    const auto lower = [](float one, float other) { return one < other ? one : other; };
    static_assert(BeamBlock::kPlanes == 5);
    const float least =
        lower(lower(lower(above(0), above(1)), lower(above(2), above(3))), above(4));
    height[i] = least + slack;
    any |= least + slack >= 0.0F ? 1 : 0;
  }
  return any;
}

}  // namespace

std::vector<BeamBlock> beam_blocks(const std::vector<Image>& images,
                                   const std::vector<BeamSides>& beams,
                                   const Eigen::Vector3d& p_WA) {
  std::vector<BeamBlock> blocks((images.size() + kBeamLanes - 1) / kBeamLanes, unseen());
  for (std::size_t i = 0; i < images.size(); ++i) {
    BeamBlock& block = blocks[i / kBeamLanes];
    const std::size_t lane = i % kBeamLanes;
    Eigen::Vector4d mirror;
    mirror << images[i].normal_W, -images[i].offset_m;
    put(mirror, p_WA, 0, lane, block);
    for (int row = 0; row < 4; ++row) {
      put(beams[i].row(row), p_WA, static_cast<std::size_t>(row) + 1, lane, block);
    }
  }
  return blocks;
}

void add_seen_from(const std::vector<BeamBlock>& blocks, std::size_t count,
                   const Eigen::Vector3f& p, InstructionSet set, std::vector<std::uint32_t>& seen) {
  const float slack = static_cast<float>(kSinglePrecision) * p.lpNorm<1>();
  const std::size_t count_of_blocks = (count + kBeamLanes - 1) / kBeamLanes;
  thread_local std::vector<float> heights;
  thread_local std::vector<std::uint32_t> with_seen;
  heights.resize(count_of_blocks * kBeamLanes);
  with_seen.resize(count_of_blocks);
  float* const height = heights.data();
  std::uint32_t* const hits = with_seen.data();
  std::size_t hit_count = 0;
  in_lanes(set, [&] {
    for (std::size_t i = 0; i < count_of_blocks; ++i) {
      const std::int32_t any = set_heights(blocks[i], p, slack, height + i * kBeamLanes);
      hits[hit_count] = static_cast<std::uint32_t>(i);
      hit_count += any != 0 ? 1 : 0;
    }
  });
  for (std::size_t k = 0; k < hit_count; ++k) {
    const std::size_t first = hits[k] * kBeamLanes;
    const std::size_t end = std::min(first + kBeamLanes, count);
    for (std::size_t i = first; i < end; ++i) {
      if (height[i] >= 0.0F) seen.push_back(static_cast<std::uint32_t>(i));
    }
  }
}

}  // namespace tagfield
