// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/near_distances.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tagfield {
namespace {

TEST(NearDistances, OfOneSource) {
  std::vector<std::uint8_t> sources(11 * 7, 0);
  sources[3 * 11 + 5] = 1;
  const std::vector<float> distances = near_distances(sources, 11, 4);
  EXPECT_EQ(distances[3 * 11 + 5], 0.0F);
  EXPECT_EQ(distances[3 * 11 + 6], 1.0F);
  EXPECT_EQ(distances[5 * 11 + 6], std::sqrt(5.0F));
  EXPECT_EQ(distances[0], 4.0F);  // √34 away: capped at the requested maximum.
}

TEST(NearDistances, OfOneSourceToTheMostCellsThatThereMayBe) {
  constexpr int kWidth = 400;
  std::vector<std::uint8_t> sources(kWidth * 150, 0);
  sources[0] = 1;
  const std::vector<float> distances = near_distances(sources, kWidth, 180);
  for (const auto& [x, y] : {std::pair(150, 90), {179, 0}, {104, 146}, {127, 127}, {250, 20}}) {
    const float expected = std::min(180.0F, std::sqrt(static_cast<float>(x * x + y * y)));
    EXPECT_FLOAT_EQ(distances[static_cast<std::size_t>(y * kWidth + x)], expected)
        << x << ", " << y;
  }
}

TEST(NearDistances, WithoutSources) {
  const std::vector<float> distances = near_distances(std::vector<std::uint8_t>(20, 0), 4, 180);
  EXPECT_TRUE(std::all_of(distances.begin(), distances.end(), [](float d) { return d == 180.0F; }));
  EXPECT_TRUE(near_distances({}, 1, 5).empty());
}

TEST(NearDistances, CellsForADistance) {
  EXPECT_EQ(cells_for(0.76, 0.05), 17);
  EXPECT_EQ(cells_for(0.0, 0.05), 1);
  EXPECT_EQ(cells_for(100.0, 0.01), 180);
}

RC_GTEST_PROP(NearDistancesProperties, EqualBruteForce, ()) {
  const int width = *rc::gen::inRange(1, 25);
  const int height = *rc::gen::inRange(1, 25);
  const int most = *rc::gen::inRange(1, 30);
  const int one_in = *rc::gen::inRange(2, 60);
  std::vector<std::uint8_t> sources;
  for (int i = 0; i < width * height; ++i) {
    sources.push_back(*rc::gen::inRange(0, one_in) == 0 ? 1 : 0);
  }
  const std::vector<float> distances = near_distances(sources, width, most);
  for (int i = 0; i < width * height; ++i) {
    int nearest = most * most;
    for (int j = 0; j < width * height; ++j) {
      if (sources[static_cast<std::size_t>(j)] == 0) continue;
      const int dx = i % width - j % width;
      const int dy = i / width - j / width;
      nearest = std::min(nearest, dx * dx + dy * dy);
    }
    RC_ASSERT(std::abs(distances[static_cast<std::size_t>(i)] -
                       std::sqrt(static_cast<float>(nearest))) < 1e-5F);
  }
}

}  // namespace
}  // namespace tagfield
