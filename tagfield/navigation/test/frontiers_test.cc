// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/frontiers.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/floor_room.h"
#include "tagfield/navigation/grid_line.h"
#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::paint;
using testing::room_of;

/// A room whose right part, behind a wall with a 1.2 m door, is unknown, with a niche on the left.
OccupancyGrid house() {
  OccupancyGrid map = room_of(10.0, 6.0);
  paint(map, {5.0, 0.0}, {5.2, 6.0}, 100);
  paint(map, {5.2, 0.0}, {10.0, 6.0}, -1);
  paint(map, {5.0, 2.4}, {5.2, 3.6}, 0);
  return map;
}

TEST(Frontiers, LooksThroughTheDoor) {
  const std::vector<Frontier> found = frontiers(house(), house(), {1.0, 1.0, 0.0}, {}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].size_m, 1.2, 0.06);
  EXPECT_NEAR(found[0].look.from_M.yaw,
              std::atan2(3.0 - found[0].look.from_M.y, 5.2 - found[0].look.from_M.x), 0.2);
  EXPECT_NEAR(std::hypot(found[0].look.from_M.x - 5.2, found[0].look.from_M.y - 3.0), 0.5, 0.1);
  const double straight = std::hypot(found[0].look.from_M.x - 1.0, found[0].look.from_M.y - 1.0);
  EXPECT_GT(found[0].way_m, straight - 0.1);
  EXPECT_LT(found[0].way_m, 1.09 * straight + 0.1);
}

TEST(Frontiers, NoneWhereAllIsKnown) {
  EXPECT_TRUE(frontiers(room_of(10.0, 6.0), room_of(10.0, 6.0), {1.0, 1.0, 0.0}, {}, {}).empty());
}

TEST(Frontiers, NoneThatCanNotBeReached) {
  OccupancyGrid map = house();
  paint(map, {3.0, 0.0}, {3.2, 6.0}, 100);
  EXPECT_TRUE(frontiers(map, map, {1.0, 1.0, 0.0}, {}, {}).empty());
}

TEST(Frontiers, NoneTooSmallOrGivenUp) {
  EXPECT_TRUE(frontiers(house(), house(), {1.0, 1.0, 0.0}, {}, {0.36, 0.05, 2.0, 8.0}).empty());
  EXPECT_TRUE(
      frontiers(house(), house(), {1.0, 1.0, 0.0}, {{{4.7, 3.0, 0.0}, {5.2, 3.0}}}, {}).empty());
  EXPECT_EQ(
      frontiers(house(), house(), {1.0, 1.0, 0.0}, {{{1.0, 3.0, 0.0}, {1.0, 4.0}}}, {}).size(), 1U);
}

TEST(Frontiers, NearAndLargeOnesComeFirst) {
  OccupancyGrid map = room_of(20.0, 6.0);
  paint(map, {0.0, 5.0}, {2.0, 6.0}, -1);    // 2 m long, near
  paint(map, {18.0, 0.0}, {20.0, 6.0}, -1);  // 6 m long, far
  const std::vector<Frontier> found = frontiers(map, map, {2.0, 3.0, 0.0}, {}, {});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_LT(found[0].look.from_M.x, 3.0);
  EXPECT_GT(found[1].look.from_M.x, 16.0);
  const std::vector<Frontier> from_afar = frontiers(map, map, {10.0, 3.0, 0.0}, {}, {});
  ASSERT_EQ(from_afar.size(), 2U);
  EXPECT_GT(from_afar[0].look.from_M.x, 16.0);
}

TEST(Frontiers, TheGroundUnderTheRobotIsKnown) {
  // The laser has seen everything ahead, and nothing behind.
  OccupancyGrid map = room_of(10.0, 6.0);
  paint(map, {0.0, 0.0}, {2.0, 6.0}, -1);
  const std::vector<Frontier> found = frontiers(map, map, {1.9, 3.0, 0.0}, {}, {});
  ASSERT_FALSE(found.empty());
  for (const Frontier& frontier : found) EXPECT_GT(frontier.look.from_M.x, 1.5);
}

TEST(Frontiers, NothingFromNowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(frontiers(house(), house(), {nan, 1.0, 0.0}, {}, {}).empty());
  EXPECT_TRUE(frontiers(house(), house(), {-70.0, 1.0, 0.0}, {}, {}).empty());
  EXPECT_TRUE(frontiers({}, {}, {1.0, 1.0, 0.0}, {}, {}).empty());
}

/// Whether a beam near the heading of `goal` reaches unknown space before any wall.
bool sees_unknown(const OccupancyGrid& map, const PlanarPose& goal, const Eigen::Vector2d& robot) {
  for (int i = -200; i <= 200; ++i) {
    const double angle = goal.yaw + 0.003 * i;
    const Eigen::Vector2d end =
        position_of(goal) + 9.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    std::int8_t last = 0;
    along_line(map, position_of(goal), end, [&](int x, int y, double) {
      // The floor under the robot counts as free.
      const bool is_under = (map.centre_of(x, y) - robot).norm() <= 0.36;
      last = is_under ? std::int8_t{0} : map.at(x, y);
      return last == 0;
    });
    if (last < 0) return true;
  }
  return false;
}

RC_GTEST_PROP(FrontiersProperties, GoalsAreClearAndSeeUnknownGround, ()) {
  OccupancyGrid map = room_of(8.0, 8.0);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d low(*rc::gen::inRange(0, 70) * 0.1, *rc::gen::inRange(0, 70) * 0.1);
    const Eigen::Vector2d size(*rc::gen::inRange(5, 25) * 0.1, *rc::gen::inRange(5, 25) * 0.1);
    paint(map, low, low + size, i % 2 == 0 ? std::int8_t{-1} : std::int8_t{100});
  }
  const Eigen::Vector2d robot(4.0, 4.0);
  for (const Frontier& frontier : frontiers(map, map, {4.0, 4.0, 0.0}, {}, {})) {
    RC_ASSERT(frontier.size_m >= 0.4);
    RC_ASSERT(frontier.way_m >= (position_of(frontier.look.from_M) - robot).norm() - 0.1);
    RC_ASSERT(sees_unknown(map, frontier.look.from_M, robot));
    RC_ASSERT(distance_to_occupied(map, position_of(frontier.look.from_M), 1.0) >= 0.41);
  }
}

}  // namespace
}  // namespace tagfield
