// SPDX-License-Identifier: Apache-2.0
// Beams and facet planes in blocks, against each plane's height in double precision.
#include "tagfield/propagation/internal/beam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace tagfield {
namespace {

struct Beams {
  Eigen::Vector3d p_WA;
  std::vector<Image> images;
  std::vector<BeamSides> sides;
};

Beams random_beams(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto direction = [&] {
    return Eigen::Vector3d(unit(random), unit(random), unit(random)).normalized();
  };
  Beams all;
  all.p_WA = 20.0 * Eigen::Vector3d(unit(random), unit(random), unit(random));
  for (std::size_t i = 0; i < count; ++i) {
    Image image;
    image.normal_W = direction();
    image.offset_m = image.normal_W.dot(all.p_WA) + 4.0 * unit(random) - 2.0;
    all.images.push_back(image);
    BeamSides sides = open_beam();
    for (int row = 0; row < 4 && i % 5 != 0; ++row) {
      const Eigen::Vector3d n = direction();
      sides.row(row) << n.transpose(), 2.0 + 4.0 * unit(random) - n.dot(all.p_WA);
    }
    all.sides.push_back(sides);
  }
  return all;
}

/// The height of `p_W` above the lowest of an image's planes [m].
double min_height(const Beams& beams, std::size_t i, const Eigen::Vector3d& p_W) {
  const Eigen::Vector4d heights =
      beams.sides[i].leftCols<3>() * p_W + Eigen::Vector4d(beams.sides[i].col(3));
  return std::min(heights.minCoeff(), beams.images[i].normal_W.dot(p_W) - beams.images[i].offset_m);
}

TEST(Beams, ThoseThatReachAPointAreFoundByEachInstructionSet) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 100U, 333U}) {
    const Beams beams = random_beams(count, random);
    const std::vector<BeamBlock> blocks = beam_blocks(beams.images, beams.sides, beams.p_WA);
    std::size_t found = 0;
    for (int point = 0; point < 100; ++point) {
      const Eigen::Vector3d from_antenna =
          3.0 * Eigen::Vector3d(unit(random), unit(random), unit(random));
      std::vector<std::uint32_t> first;
      for (const InstructionSet set : instruction_sets()) {
        std::vector<std::uint32_t> seen;
        add_seen_from(blocks, count, from_antenna.cast<float>(), set, seen);
        EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
        if (set == instruction_sets().front()) first = seen;
        EXPECT_EQ(seen, first);
      }
      for (std::uint32_t i = 0; i < count; ++i) {
        const double height = min_height(beams, i, beams.p_WA + from_antenna);
        const bool is_seen = std::binary_search(first.begin(), first.end(), i);
        EXPECT_TRUE(is_seen || height < 0.0) << height;
        EXPECT_FALSE(is_seen && height < -1e-4) << height;
      }
      found += first.size();
    }
    EXPECT_TRUE(count < 20 || found > 100) << found;
  }
}

TEST(Beams, OnlyTheFirstImagesAreTested) {
  std::mt19937 random(2);
  const Beams beams = random_beams(40, random);
  const std::vector<BeamBlock> blocks = beam_blocks(beams.images, beams.sides, beams.p_WA);
  const InstructionSet set = instruction_sets().back();
  const Eigen::Vector3f p(0.5F, -0.25F, 0.75F);
  std::vector<std::uint32_t> all;
  add_seen_from(blocks, 40, p, set, all);
  for (std::size_t count = 0; count <= 40; ++count) {
    std::vector<std::uint32_t> seen;
    add_seen_from(blocks, count, p, set, seen);
    const auto end = std::lower_bound(all.begin(), all.end(), count);
    EXPECT_EQ(seen, std::vector<std::uint32_t>(all.begin(), end));
  }
}

}  // namespace
}  // namespace tagfield
