// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/explorer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/grid_line.h"
#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::paint;
using testing::room_of;

constexpr double kSight = 5.0;

/// Two rooms with a door between them, a box 0.3 m from a wall, and a closed cupboard.
OccupancyGrid true_house() {
  OccupancyGrid map = room_of(10.0, 6.0);
  paint(map, {5.0, 0.0}, {5.2, 6.0}, 100);
  paint(map, {5.0, 2.4}, {5.2, 3.6}, 0);
  paint(map, {7.0, 0.5}, {8.0, 1.5}, 100);
  paint(map, {1.0, 5.0}, {2.0, 6.0}, 100);
  return map;
}

/// Enters into `map` what a short-range 360° laser at `place` sees of the ground truth.
void look_around(const OccupancyGrid& truth, const Eigen::Vector2d& place, OccupancyGrid& map) {
  for (int i = 0; i < 1440; ++i) {
    const double angle = i * kTwoPi / 1440;
    const Eigen::Vector2d end = place + kSight * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    along_line(truth, place, end, [&](int x, int y, double) {
      if (!truth.contains(x, y)) return false;
      map.cells[map.index(x, y)] = truth.at(x, y);
      return truth.at(x, y) == 0;
    });
  }
}

struct Tour {
  OccupancyGrid map;
  std::vector<PlanarPose> goals;
  Explorer explorer;
};

/// Moves a robot to each goal instantly.
Tour explored(const OccupancyGrid& truth, const PlanarPose& start, int max_goals) {
  Tour tour{truth, {}, Explorer({}, start)};
  tour.map.cells.assign(truth.cells.size(), -1);
  PlanarPose pose = start;
  bool has_ended = false;
  while (!tour.explorer.finished() && static_cast<int>(tour.goals.size()) < max_goals) {
    look_around(truth, position_of(pose), tour.map);
    const OccupancyGrid map = tour.explorer.with_start(tour.map);
    const auto goal = tour.explorer.next(map, map, pose, has_ended);
    has_ended = true;
    if (!goal) continue;
    pose = *goal;
    tour.goals.push_back(pose);
  }
  return tour;
}

TEST(Explorer, SeesBothRoomsAndComesHome) {
  const OccupancyGrid truth = true_house();
  const PlanarPose start{1.5, 1.5, 0.3};
  const Tour tour = explored(truth, start, 50);
  ASSERT_TRUE(tour.explorer.finished());
  ASSERT_FALSE(tour.goals.empty());
  EXPECT_EQ(tour.goals.back().x, start.x);
  EXPECT_EQ(tour.goals.back().y, start.y);
  std::size_t free = 0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < truth.cells.size(); ++i) {
    if (truth.cells[i] != 0) continue;
    ++free;
    seen += tour.map.cells[i] == 0 ? 1U : 0U;
  }
  EXPECT_GT(static_cast<double>(seen), 0.999 * static_cast<double>(free));
}

TEST(Explorer, StandsClearOfAllAndKnowsWhenToGoHome) {
  const OccupancyGrid truth = true_house();
  const Tour tour = explored(truth, {1.5, 1.5, 0.0}, 50);
  for (const PlanarPose& goal : tour.goals) {
    EXPECT_GT((Eigen::Vector2d(goal.x, goal.y) - Eigen::Vector2d(7.5, 1.0)).norm(), 0.86);
    EXPECT_EQ(truth.at(truth.cell_of(position_of(goal)).x(), truth.cell_of(position_of(goal)).y()),
              0);
  }
  EXPECT_TRUE(tour.explorer.is_going_home());
}

TEST(Explorer, LooksAroundWhereAFrontierStaysOpenAndThenLeavesIt) {
  // The laser never sees anything beyond the line x = 4, as behind a curtain.
  OccupancyGrid map = room_of(8.0, 6.0);
  paint(map, {4.0, 0.0}, {8.0, 6.0}, -1);
  Explorer explorer({}, {1.0, 3.0, 0.0});
  PlanarPose pose{1.0, 3.0, 0.0};
  std::vector<PlanarPose> goals;
  for (bool has_ended = false; !explorer.finished(); has_ended = true) {
    ASSERT_LT(goals.size(), 60U);
    if (const auto goal = explorer.next(map, map, pose, has_ended)) {
      goals.push_back(*goal);
      pose = *goal;
    }
  }
  ASSERT_GE(goals.size(), 4U);
  // To either side, on the spot.
  for (std::size_t i = 1; i <= 2; ++i) {
    EXPECT_EQ(goals[i].x, goals[0].x);
    EXPECT_EQ(goals[i].y, goals[0].y);
    EXPECT_NEAR(std::abs(wrap_to_pi(goals[i].yaw - goals[0].yaw)), 0.6, 1e-9);
  }
  EXPECT_NEAR(wrap_to_pi(goals[1].yaw - goals[2].yaw), 1.2, 1e-9);
}

TEST(Explorer, GoesOnToWhatIsStillOpen) {
  const OccupancyGrid truth = true_house();
  OccupancyGrid map = truth;
  map.cells.assign(truth.cells.size(), -1);
  look_around(truth, {1.5, 1.5}, map);
  Explorer explorer({}, {1.5, 1.5, 0.0});
  ASSERT_TRUE(explorer.next(map, map, {1.5, 1.5, 0.0}, false));
  EXPECT_FALSE(explorer.next(map, map, {1.6, 1.5, 0.0}, false));
  // Everything becomes visible before the robot gets there: nothing is left to see.
  const auto home = explorer.next(truth, truth, {1.7, 1.5, 0.0}, false);
  ASSERT_TRUE(home);
  EXPECT_EQ(home->x, 1.5);
  EXPECT_TRUE(explorer.is_going_home());
  EXPECT_FALSE(explorer.finished());
}

TEST(Explorer, LooksOverWhatIsOnlyInTheWay) {
  // A low step in the middle: not on the map, but not drivable.
  OccupancyGrid map = room_of(10.0, 6.0);
  paint(map, {6.0, 0.0}, {10.0, 6.0}, -1);
  OccupancyGrid drivable = map;
  paint(drivable, {5.0, 0.0}, {6.1, 6.0}, 100);
  Explorer explorer({}, {1.0, 3.0, 0.0});
  const auto goal = explorer.next(map, drivable, {1.0, 3.0, 0.0}, false);
  ASSERT_TRUE(goal);
  EXPECT_FALSE(explorer.is_going_home());
  EXPECT_LT(goal->x, 4.6);
  EXPECT_GT(goal->x, 4.0);
}

}  // namespace
}  // namespace tagfield
