// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/global_planner.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <queue>

#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/grid_line.h"
#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::paint;
using testing::room_of;

const RobotRoom kSize{0.36, 0.05, 0.3};

double length_of(const std::vector<Eigen::Vector2d>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
  return length;
}

TEST(GlobalPlanner, IsStraightInTheOpen) {
  const Plan found = plan(room_of(12.0, 8.0), {}, {1.5, 1.5, 0.0}, {10.0, 6.3, 0.0}, kSize);
  EXPECT_EQ(found.refusal, "");
  EXPECT_EQ(found.way.front(), Eigen::Vector2d(1.5, 1.5));
  EXPECT_EQ(found.way.back(), Eigen::Vector2d(10.0, 6.3));
  EXPECT_LT(length_of(found.way), 1.005 * std::hypot(8.5, 4.8));
  EXPECT_LE(found.way.size(), 4U);
}

TEST(GlobalPlanner, GoesRoundAndKeepsItsDistance) {
  OccupancyGrid map = room_of(12.0, 8.0);
  paint(map, {5.0, 0.0}, {5.5, 5.0}, 100);
  const Plan found = plan(map, {}, {2.0, 2.0, 0.0}, {9.0, 2.0, 0.0}, kSize);
  ASSERT_EQ(found.refusal, "");
  double nearest = 10.0;
  for (std::size_t i = 1; i < found.way.size(); ++i) {
    for (int k = 0; k <= 100; ++k) {
      const Eigen::Vector2d p = found.way[i - 1] + (found.way[i] - found.way[i - 1]) * (k / 100.0);
      const Eigen::Vector2d off((std::abs(p.x() - 5.25) - 0.25), p.y() - 5.0);
      nearest = std::min(nearest, off.cwiseMax(0.0).norm());
    }
  }
  // There is enough room: the full clearance, except where a corner is cut.
  EXPECT_GT(nearest, 0.55);
  // Straight to the corner's circle of 0.7 m, around it, and on.
  EXPECT_LT(length_of(found.way), 11.0);
}

TEST(GlobalPlanner, TakesANarrowDoorIfItMust) {
  OccupancyGrid map = room_of(12.0, 8.0);
  paint(map, {5.0, 0.0}, {5.2, 3.5}, 100);
  paint(map, {5.0, 4.4}, {5.2, 8.0}, 100);
  EXPECT_EQ(plan(map, {}, {2.0, 2.0, 0.0}, {9.0, 2.0, 0.0}, kSize).refusal, "");
  paint(map, {5.0, 4.2}, {5.2, 8.0}, 100);
  const std::string refusal = plan(map, {}, {2.0, 2.0, 0.0}, {9.0, 2.0, 0.0}, kSize).refusal;
  EXPECT_NE(refusal.find("no path"), std::string::npos) << refusal;
}

TEST(GlobalPlanner, PrefersTheWideWayIfItIsNotMuchLonger) {
  // A wall with a narrow gap straight ahead and a wide one 1 m beside it.
  OccupancyGrid map = room_of(12.0, 8.0);
  paint(map, {5.0, 0.0}, {6.5, 8.0}, 100);
  paint(map, {5.0, 3.55}, {6.5, 4.45}, 0);
  paint(map, {5.0, 4.8}, {6.5, 7.0}, 0);
  const Plan found = plan(map, {}, {2.0, 4.5, 0.0}, {10.0, 4.5, 0.0}, kSize);
  ASSERT_EQ(found.refusal, "");
  for (const Eigen::Vector2d& p : found.way) {
    if (p.x() > 5.0 && p.x() < 6.5) {
      EXPECT_GT(p.y(), 4.8);
    }
  }
}

TEST(GlobalPlanner, DoesNotCrossUnknownGround) {
  OccupancyGrid map = room_of(12.0, 8.0);
  paint(map, {5.0, 0.0}, {6.0, 5.0}, -1);
  const Plan found = plan(map, {}, {2.0, 2.0, 0.0}, {9.0, 2.0, 0.0}, kSize);
  ASSERT_EQ(found.refusal, "");
  for (std::size_t i = 1; i < found.way.size(); ++i) {
    EXPECT_TRUE(along_line(map, found.way[i - 1], found.way[i],
                           [&](int x, int y, double) { return map.at(x, y) == 0; }));
  }
}

TEST(GlobalPlanner, GoesRoundWhatWasSeen) {
  std::vector<Eigen::Vector2d> seen;
  for (int i = 0; i < 60; ++i) seen.emplace_back(5.0, 0.1 * i);
  const OccupancyGrid map = room_of(12.0, 8.0);
  const Plan found = plan(map, seen, {2.0, 2.0, 0.0}, {9.0, 2.0, 0.0}, kSize);
  ASSERT_EQ(found.refusal, "");
  EXPECT_GT(length_of(found.way), 9.0);
}

TEST(GlobalPlanner, FaultsOfTheGoal) {
  OccupancyGrid map = room_of(12.0, 8.0);
  paint(map, {8.0, 4.0}, {9.0, 5.0}, -1);
  const auto fault = [&](const PlanarPose& goal) {
    return fault_of(map, {2.0, 2.0, 0.0}, goal, kSize);
  };
  EXPECT_EQ(fault({6.0, 4.0, 0.0}), "");
  EXPECT_EQ(fault({0.47, 4.0, 0.0}), "");  // 0.42 m from the wall's face.
  EXPECT_EQ(fault({13.0, 4.0, 0.0}), "goal (13.00, 4.00): off the map");
  EXPECT_EQ(fault({0.02, 4.0, 0.0}), "goal (0.02, 4.00): on an obstacle");
  EXPECT_EQ(fault({8.5, 4.5, 0.0}), "goal (8.50, 4.50): on unknown ground");
  EXPECT_EQ(fault({0.45, 4.0, 0.0}), "goal (0.45, 4.00): nearer than 0.41 m to an obstacle");
}

/// Reference for Dijkstra's algorithm: the costs of all cells by Bellman's equations.
std::vector<std::int64_t> relaxed_costs(const FloorRoom& floor, const Eigen::Vector2i& from) {
  const OccupancyGrid& grid = floor.grid;
  std::vector<std::int64_t> costs(grid.cells.size(), -1);
  costs[grid.index(from.x(), from.y())] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const std::int64_t here = costs[grid.index(x, y)];
        if (here < 0) continue;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const int w = floor.weight(x + dx, y + dy);
            if (w == 0 || (dx == 0 && dy == 0)) continue;
            if (dx != 0 && dy != 0 &&
                (floor.weight(x + dx, y) == 0 || floor.weight(x, y + dy) == 0)) {
              continue;
            }
            const std::int64_t cost =
                here + (dx != 0 && dy != 0 ? 17 : 12) * (floor.weight(x, y) + w) / 2;
            std::int64_t& there = costs[grid.index(x + dx, y + dy)];
            if (there >= 0 && there <= cost) continue;
            there = cost;
            changed = true;
          }
        }
      }
    }
  }
  return costs;
}

RC_GTEST_PROP(GlobalPlannerProperties, SpreadFindsTheCheapestWays, ()) {
  FloorRoom floor{room_of(1.0, 0.8), std::vector<std::uint8_t>(320)};
  for (std::uint8_t& weight : floor.weights) {
    const int draw = *rc::gen::inRange(0, 50);
    weight = static_cast<std::uint8_t>(draw < 15 ? 0 : std::max(4, draw - 10));
  }
  const Eigen::Vector2i from(*rc::gen::inRange(0, 20), *rc::gen::inRange(0, 16));
  floor.weights[floor.grid.index(from.x(), from.y())] = 4;
  const std::vector<std::int64_t> expected = relaxed_costs(floor, from);
  const Spread found = spread(floor, from);
  for (std::size_t i = 0; i < expected.size(); ++i) RC_ASSERT(found.costs[i] == expected[i]);
  const Eigen::Vector2i to(*rc::gen::inRange(0, 20), *rc::gen::inRange(0, 16));
  const std::size_t end = floor.grid.index(to.x(), to.y());
  RC_ASSERT(spread(floor, from, to).costs[end] == expected[end]);
}

TEST(GlobalPlanner, WayBackIsARowOfNeighbours) {
  const FloorRoom floor = floor_room(room_of(6.0, 6.0), {}, std::nullopt, kSize);
  const Spread ways = spread(floor, {20, 20});
  const std::vector<Eigen::Vector2i> way = backtrack(floor, ways, {90, 60});
  EXPECT_EQ(way.front(), Eigen::Vector2i(90, 60));
  EXPECT_EQ(way.back(), Eigen::Vector2i(20, 20));
  for (std::size_t i = 1; i < way.size(); ++i) {
    EXPECT_EQ((way[i] - way[i - 1]).cwiseAbs().maxCoeff(), 1);
  }
}

}  // namespace
}  // namespace tagfield
