// SPDX-License-Identifier: Apache-2.0
// Facets in blocks, against each facet's bounding sphere and plane in double precision.
#include "tagfield/propagation/internal/facet_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace tagfield {
namespace {

using Random = std::mt19937;

double unit(Random& random) { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }

Eigen::Vector3d any_vector(Random& random) {
  const double x = unit(random);
  const double y = unit(random);
  return {x, y, unit(random)};
}

std::vector<Facet> random_facets(std::size_t count, const Eigen::Vector3d& middle, Random& random) {
  std::vector<Facet> facets(count);
  for (Facet& facet : facets) {
    facet.normal_W = any_vector(random).normalized();
    facet.axis_u_W = facet.normal_W.unitOrthogonal();
    facet.axis_v_W = facet.normal_W.cross(facet.axis_u_W);
    facet.corner_W = middle + 10.0 * any_vector(random);
    facet.offset_m = facet.normal_W.dot(facet.corner_W);
    const double width = 1.2 + unit(random);
    facet.size_m = {width, 1.2 + unit(random)};
    facet.unbounded = random() % 20 == 0;
    facet.two_sided = random() % 3 == 0;
  }
  return facets;
}

struct Beam {
  BeamSides sides = open_beam();
  Image image;
};

Beam random_beam(const Eigen::Vector3d& middle, Random& random) {
  Beam beam;
  beam.image.p_W = middle + 12.0 * any_vector(random);
  beam.image.normal_W = any_vector(random).normalized();
  beam.image.offset_m = beam.image.normal_W.dot(middle) + 3.0 * unit(random);
  const int rows = static_cast<int>(random() % 5);
  for (int row = 0; row < rows; ++row) {
    const Eigen::Vector3d n = any_vector(random).normalized();
    beam.sides.row(row) << n.transpose(), 4.0 + 4.0 * unit(random) - n.dot(middle);
  }
  return beam;
}

/// How far the facet is from being of no use [m]; negative if it is of none.
double reserve(const Facet& facet, float side, const Beam& beam) {
  const double of_image = facet.normal_W.dot(beam.image.p_W) - facet.offset_m;
  const double in_front = side == 0.0F ? 1.0 : side * of_image;
  if (facet.unbounded) return in_front;
  const Eigen::Vector3d centre = facet.corner_W + 0.5 * facet.size_m.x() * facet.axis_u_W +
                                 0.5 * facet.size_m.y() * facet.axis_v_W;
  double least = beam.image.normal_W.dot(centre) - beam.image.offset_m;
  for (int row = 0; row < 4; ++row) {
    const Eigen::Vector3d n = beam.sides.row(row).head<3>();
    least = std::min(least, n.dot(centre) + beam.sides(row, 3));
  }
  return std::min(in_front, least + 0.5 * facet.size_m.norm());
}

TEST(FacetBlocks, FacetsInABeamAreFoundByEachInstructionSet) {
  Random random(1);
  std::size_t found = 0;
  std::size_t left_out = 0;
  for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 100U, 333U}) {
    for (const double away : {0.0, 30.0, 5000.0}) {
      const Eigen::Vector3d middle = away * any_vector(random).normalized();
      const std::vector<Facet> facets = random_facets(count, middle, random);
      const std::vector<FacetBlock> blocks = facet_blocks(facets);
      ReflectingSides sides(blocks.size() * kFacetLanes, 0.0F);
      for (std::size_t i = 0; i < count; ++i) {
        if (!facets[i].two_sided) sides[i] = random() % 4 == 0 ? -1.0F : 1.0F;
      }
      for (int k = 0; k < 40; ++k) {
        const Beam beam = random_beam(middle, random);
        std::vector<std::uint32_t> first;
        for (const InstructionSet set : instruction_sets()) {
          std::vector<std::uint32_t> kept;
          add_facets_in(blocks, sides, beam.sides, beam.image, set, kept);
          if (set == instruction_sets().front()) first = kept;
          EXPECT_EQ(kept, first);
        }
        EXPECT_TRUE(std::is_sorted(first.begin(), first.end()));
        EXPECT_TRUE(first.empty() || first.back() < count);
        for (std::uint32_t i = 0; i < count; ++i) {
          const double margin = reserve(facets[i], sides[i], beam);
          const bool is_kept = std::binary_search(first.begin(), first.end(), i);
          EXPECT_TRUE(is_kept || margin < -1e-6) << margin;
          EXPECT_FALSE(is_kept && margin < -1e-5 * (10.0 + away)) << margin;
        }
        found += first.size();
        left_out += count - first.size();
      }
    }
  }
  EXPECT_GT(found, 1000U);
  EXPECT_GT(left_out, 1000U);
}

}  // namespace
}  // namespace tagfield
