// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/internal/facet_blocks.h"

#include <cmath>
#include <limits>

#include "tagfield/base/single_precision.h"

namespace tagfield {
namespace {

FacetBlock with_nothing() {
  FacetBlock block;
  block.radii.fill(-std::numeric_limits<float>::infinity());
  return block;
}

void put(const Facet& facet, std::size_t lane, FacetBlock& block) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = std::numeric_limits<double>::infinity();
  if (!facet.unbounded) {
    centre = facet.corner_W + 0.5 * facet.size_m.x() * facet.axis_u_W +
             0.5 * facet.size_m.y() * facet.axis_v_W;
    radius = 0.5 * facet.size_m.norm() + kSinglePrecision * (1.0 + centre.lpNorm<1>());
  }
  for (int axis = 0; axis < 3; ++axis) {
    block.centres[static_cast<std::size_t>(axis)][lane] = static_cast<float>(centre[axis]);
    block.normals[static_cast<std::size_t>(axis)][lane] = static_cast<float>(facet.normal_W[axis]);
  }
  block.radii[lane] = static_cast<float>(radius);
  block.offsets[lane] = static_cast<float>(facet.offset_m);
  block.slacks[lane] = static_cast<float>(kSinglePrecision * (1.0 + std::abs(facet.offset_m)));
}

/// The half spaces n·p + w ≥ 0 of a beam and of its mirror's front, with the image's position.
struct Cone {
  static constexpr std::size_t kPlanes = 5;
  float n[kPlanes][3];
  float w[kPlanes];  ///< With what rounding may take.
  float p[3];
  float slack = 0.0F;  ///< Of heights of `p`.
};

Cone cone_of(const BeamSides& beam, const Image& image) {
  Cone cone{};
  const auto set = [&](std::size_t k, const Eigen::Vector3d& normal, double offset) {
    for (int axis = 0; axis < 3; ++axis) cone.n[k][axis] = static_cast<float>(normal[axis]);
    cone.w[k] = static_cast<float>(offset + kSinglePrecision * (1.0 + std::abs(offset)));
  };
  set(0, image.normal_W, -image.offset_m);
  for (int row = 0; row < 4; ++row) {
    set(static_cast<std::size_t>(row) + 1, beam.row(row).head<3>(), beam(row, 3));
  }
  for (int axis = 0; axis < 3; ++axis) cone.p[axis] = static_cast<float>(image.p_W[axis]);
  cone.slack = static_cast<float>(kSinglePrecision * image.p_W.lpNorm<1>());
  return cone;
}

/// Sets `height[i]` to at least 0 for each lane whose facet may be of use. Returns 0 if none is.
/// Written for vector instructions.
inline std::int32_t set_heights(const FacetBlock& block, const float* side, const Cone& cone,
                                float* height) {
  const auto& c = block.centres;
  const auto& n = block.normals;
  std::int32_t any = 0;
#pragma GCC ivdep
  for (std::size_t i = 0; i < kFacetLanes; ++i) {
    const auto above = [&](std::size_t k) {
      return cone.n[k][0] * c[0][i] + cone.n[k][1] * c[1][i] + cone.n[k][2] * c[2][i] + cone.w[k];
    };
    const auto lower = [](float one, float other) { return one < other ? one : other; };
    static_assert(Cone::kPlanes == 5);
    const float in_beam =
        lower(lower(lower(above(0), above(1)), lower(above(2), above(3))), above(4)) +
        block.radii[i];
    const float of_image = n[0][i] * cone.p[0] + n[1][i] * cone.p[1] + n[2][i] * cone.p[2];
    const float in_front = side[i] * (of_image - block.offsets[i]) + block.slacks[i] + cone.slack;
    height[i] = lower(in_beam, in_front);
    any |= height[i] >= 0.0F ? 1 : 0;
  }
  return any;
}

}  // namespace

std::vector<FacetBlock> facet_blocks(const std::vector<Facet>& facets) {
  std::vector<FacetBlock> blocks((facets.size() + kFacetLanes - 1) / kFacetLanes, with_nothing());
  for (std::size_t i = 0; i < facets.size(); ++i) {
    put(facets[i], i % kFacetLanes, blocks[i / kFacetLanes]);
  }
  return blocks;
}

void add_facets_in(const std::vector<FacetBlock>& blocks, const ReflectingSides& sides,
                   const BeamSides& beam, const Image& image, InstructionSet set,
                   std::vector<std::uint32_t>& facets) {
  const Cone cone = cone_of(beam, image);
  thread_local std::vector<float> heights;
  thread_local std::vector<std::uint32_t> with_some;
  heights.resize(blocks.size() * kFacetLanes);
  with_some.resize(blocks.size());
  float* const height = heights.data();
  std::uint32_t* const hits = with_some.data();
  std::size_t hit_count = 0;
  in_lanes(set, [&] {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const std::size_t first = i * kFacetLanes;
      const std::int32_t any = set_heights(blocks[i], sides.data() + first, cone, height + first);
      hits[hit_count] = static_cast<std::uint32_t>(first);
      hit_count += any != 0 ? 1 : 0;
    }
  });
  for (std::size_t k = 0; k < hit_count; ++k) {
    for (std::uint32_t i = hits[k]; i < hits[k] + kFacetLanes; ++i) {
      if (height[i] >= 0.0F) facets.push_back(i);
    }
  }
}

}  // namespace tagfield
