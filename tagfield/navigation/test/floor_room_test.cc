// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/floor_room.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::grid_of;
using testing::paint;
using testing::room_of;

std::uint8_t weight_at(const FloorRoom& floor, const Eigen::Vector2d& p) {
  const Eigen::Vector2i cell = floor.grid.cell_of(p);
  return floor.weight(cell.x(), cell.y());
}

TEST(FloorRoom, WeighsByTheDistanceToWalls) {
  const FloorRoom floor = floor_room(room_of(10.0, 6.0), {}, std::nullopt, {0.36, 0.05, 0.3});
  EXPECT_EQ(weight_at(floor, {0.01, 3.0}), 0);          // in the wall
  EXPECT_EQ(weight_at(floor, {0.425 - 0.01, 3.0}), 0);  // 0.4 m between centres
  // 0.45 m: 0.26 short of 0.3 m.
  EXPECT_EQ(weight_at(floor, {0.475, 3.0}), std::lround(4 + 16 * 0.8667 * 0.8667));
  EXPECT_EQ(weight_at(floor, {0.775, 3.0}), FloorRoom::kFar);
  EXPECT_EQ(weight_at(floor, {5.0, 3.0}), FloorRoom::kFar);
  EXPECT_EQ(weight_at(floor, {50.0, 3.0}), 0);
}

TEST(FloorRoom, WithoutClearanceAllThatIsAllowedWeighsTheSame) {
  const FloorRoom floor = floor_room(room_of(10.0, 6.0), {}, std::nullopt, {0.36, 0.05, 0.0});
  EXPECT_EQ(weight_at(floor, {0.475, 3.0}), FloorRoom::kFar);
  EXPECT_EQ(weight_at(floor, {0.4, 3.0}), 0);
}

TEST(FloorRoom, KnowsWhatWasSeen) {
  const FloorRoom floor =
      floor_room(room_of(10.0, 6.0), {{5.0, 3.0}, {-7.0, 3.0}}, std::nullopt, {0.36, 0.05, 0.3});
  EXPECT_EQ(weight_at(floor, {5.0, 3.0}), 0);
  EXPECT_EQ(weight_at(floor, {5.0, 3.35}), 0);
  EXPECT_GT(weight_at(floor, {5.0, 3.5}), 0);
}

TEST(FloorRoom, KeepsTwoThirdsOfTheRadiusFromUnknownGround) {
  OccupancyGrid map = room_of(10.0, 6.0);
  paint(map, {5.0, 0.0}, {10.0, 6.0}, -1);
  const FloorRoom floor = floor_room(map, {}, std::nullopt, {0.36, 0.05, 0.3});
  EXPECT_EQ(weight_at(floor, {5.1, 3.0}), 0);
  EXPECT_EQ(weight_at(floor, {4.82, 3.0}), 0);
  EXPECT_GT(weight_at(floor, {4.74, 3.0}), 0);
}

TEST(FloorRoom, TheRobotStandsOnFreeGround) {
  OccupancyGrid map = room_of(10.0, 6.0);
  paint(map, {0.1, 0.1}, {5.0, 5.9}, -1);
  const FloorRoom floor = floor_room(map, {}, Eigen::Vector2d(4.9, 3.0), {0.36, 0.05, 0.3});
  EXPECT_GT(weight_at(floor, {4.9, 3.0}), 0);
  EXPECT_GT(weight_at(floor, {5.3, 3.0}), 0);
  EXPECT_EQ(weight_at(floor, {4.4, 3.0}), 0);
}

TEST(FloorRoom, LetsTheRobotOutButNotNearer) {
  const FloorRoom floor =
      floor_room(room_of(10.0, 6.0), {}, Eigen::Vector2d(3.0, 0.325), {0.36, 0.05, 0.3});
  EXPECT_EQ(weight_at(floor, {3.0, 0.325}), FloorRoom::kOut);
  EXPECT_EQ(weight_at(floor, {3.3, 0.375}), FloorRoom::kOut);
  EXPECT_EQ(weight_at(floor, {3.0, 0.275}), 0);
  EXPECT_EQ(weight_at(floor, {5.0, 0.325}), 0);  // Too far from the robot.
}

TEST(FloorRoom, SpecksAreFreeAndEdgesAreNot) {
  const OccupancyGrid cleaned = without_specks(
      grid_of({"......", ".?....", "......", "..???.", "......", "???...", "???...", "???..."}));
  EXPECT_EQ(cleaned.at(1, 6), 0);
  EXPECT_EQ(cleaned.at(3, 4), 0);
  EXPECT_EQ(cleaned.at(1, 1), -1);
  EXPECT_EQ(cleaned.at(1, 2), -1);
  EXPECT_EQ(cleaned.at(2, 1), -1);
}

TEST(FloorRoom, ReadsProbabilitiesByTheUsualThresholds) {
  OccupancyGrid grid = room_of(1.0, 1.0);
  grid.cells[grid.index(5, 5)] = 65;
  grid.cells[grid.index(6, 5)] = 19;
  const OccupancyGrid cleaned = without_specks(grid);
  EXPECT_EQ(cleaned.at(5, 5), 100);
  EXPECT_EQ(cleaned.at(6, 5), 0);
}

RC_GTEST_PROP(FloorRoomProperties, DistanceToOccupiedIsThatToTheSquares, ()) {
  OccupancyGrid grid = room_of(3.0, 3.0);
  const auto draw = [](int low, int high) { return *rc::gen::inRange(low, high) * 0.001; };
  for (int i = 0; i < 4; ++i) {
    grid.cells[grid.index(*rc::gen::inRange(0, 60), *rc::gen::inRange(0, 60))] = 100;
  }
  const Eigen::Vector2d p(draw(0, 3000), draw(0, 3000));
  double nearest = 1.0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      if (grid.at(x, y) != 100) continue;
      const double dx = std::max({x * 0.05 - p.x(), p.x() - (x + 1) * 0.05, 0.0});
      const double dy = std::max({y * 0.05 - p.y(), p.y() - (y + 1) * 0.05, 0.0});
      nearest = std::min(nearest, std::hypot(dx, dy));
    }
  }
  RC_ASSERT(std::abs(distance_to_occupied(grid, p, 1.0) - nearest) < 1e-9);
}

}  // namespace
}  // namespace tagfield
