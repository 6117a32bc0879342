// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/occupancy_grid.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

namespace tagfield {
namespace {

OccupancyGrid grid_of(int width, int height, double resolution_m = 0.05) {
  OccupancyGrid grid;
  grid.resolution_m = resolution_m;
  grid.width = width;
  grid.height = height;
  grid.origin = {-1.0, 2.0};
  grid.cells.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  return grid;
}

TEST(OccupancyGrid, CellsAndPointsBelongTogether) {
  const OccupancyGrid grid = grid_of(7, 4, 0.5);
  EXPECT_EQ(grid.centre_of(0, 0), Eigen::Vector2d(-0.75, 2.25));
  EXPECT_EQ(grid.cell_of({-0.75, 2.25}), Eigen::Vector2i(0, 0));
  EXPECT_EQ(grid.cell_of({-1.01, 1.99}), Eigen::Vector2i(-1, -1));
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 7; ++x)
      EXPECT_EQ(grid.cell_of(grid.centre_of(x, y)), Eigen::Vector2i(x, y));
  }
  EXPECT_EQ(grid.index(3, 2), 17U);
}

TEST(OccupancyGrid, IsUnknownBeyondItsRim) {
  const OccupancyGrid grid = grid_of(3, 2);
  EXPECT_EQ(grid.at(2, 1), 0);
  for (const auto& [x, y] : {std::pair{-1, 0}, {0, -1}, {3, 0}, {0, 2}}) {
    EXPECT_EQ(grid.at(x, y), -1);
    EXPECT_FALSE(grid.contains(x, y));
  }
}

TEST(OccupancyGrid, PointsOffAllMapsAreInNoCell) {
  const OccupancyGrid grid = grid_of(3, 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf, 1e300, -1e300}) {
    const Eigen::Vector2i cell = grid.cell_of({bad, 2.01});
    EXPECT_FALSE(grid.contains(cell.x(), cell.y())) << bad;
  }
}

TEST(OccupancyGrid, ThresholdsAreTheMapServers) {
  for (const int cell : {0, 19}) EXPECT_TRUE(is_free(static_cast<std::int8_t>(cell)));
  for (const int cell : {-1, 20, 64, 100}) EXPECT_FALSE(is_free(static_cast<std::int8_t>(cell)));
  for (const int cell : {65, 100}) EXPECT_TRUE(is_occupied(static_cast<std::int8_t>(cell)));
  for (const int cell : {-1, 0, 64}) EXPECT_FALSE(is_occupied(static_cast<std::int8_t>(cell)));
}

TEST(DistanceField, OfOneCellIsItsEuclideanDistance) {
  const OccupancyGrid grid = grid_of(30, 20, 0.1);
  std::vector<bool> is_source(600, false);
  is_source[grid.index(7, 11)] = true;
  const std::vector<float> field = distance_field(grid, is_source, 100.0);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) {
      EXPECT_NEAR(field[grid.index(x, y)], 0.1 * std::hypot(x - 7, y - 11), 1e-6);
    }
  }
}

TEST(DistanceField, WithoutSourcesIsTheMost) {
  const OccupancyGrid grid = grid_of(3, 2);
  const std::vector<float> field = distance_field(grid, std::vector<bool>(6, false), 1.5);
  EXPECT_EQ(field, std::vector<float>(6, 1.5F));
  EXPECT_TRUE(distance_field(grid_of(0, 0), {}, 1.5).empty());
}

RC_GTEST_PROP(DistanceField, IsTheNearestOfAllSources, ()) {
  const OccupancyGrid grid = grid_of(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40), 0.05);
  const double max_m = 0.05 * *rc::gen::inRange(1, 60);
  const int rarity = *rc::gen::inRange(2, 200);
  std::vector<bool> is_source;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    is_source.push_back(*rc::gen::inRange(0, rarity) == 0);
  }
  const std::vector<float> field = distance_field(grid, is_source, max_m);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      double nearest = max_m;
      for (int v = 0; v < grid.height; ++v) {
        for (int u = 0; u < grid.width; ++u) {
          if (is_source[grid.index(u, v)]) {
            nearest = std::min(nearest, 0.05 * std::hypot(u - x, v - y));
          }
        }
      }
      RC_ASSERT(std::abs(field[grid.index(x, y)] - nearest) < 1e-6);
    }
  }
}

}  // namespace
}  // namespace tagfield
