// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/laser/simulated_laser.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {
namespace {

ObstacleSpec walker() {
  ObstacleSpec spec;
  spec.radius_m = 0.25;
  spec.motion = {{time_from_seconds(1.0), from_translation({0.0, 0.0, 0.0})},
                 {time_from_seconds(3.0), from_translation({4.0, 2.0, 0.0})}};
  return spec;
}

TEST(ObstaclesAt, GoStraightBetweenRowsAndStandOutside) {
  const auto at = [](double seconds) {
    return obstacles_at({walker()}, time_from_seconds(seconds)).discs.at(0).centre;
  };
  EXPECT_EQ(at(0.0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_TRUE(at(1.5).isApprox(Eigen::Vector2d(1.0, 0.5)));
  EXPECT_TRUE(at(2.0).isApprox(Eigen::Vector2d(2.0, 1.0)));
  EXPECT_EQ(at(9.0), Eigen::Vector2d(4.0, 2.0));
}

TEST(ObstaclesAt, AreThereFromTheirBeginningUntilTheirEnd) {
  ObstacleSpec box;
  box.size_m = {1.0, 0.5};
  box.yaw_rad = 0.3;
  box.motion = {{Time{}, from_translation({1.0, 2.0, 0.0})}};
  box.appears = time_from_seconds(2.0);
  box.disappears = time_from_seconds(4.0);
  const auto count = [&](double seconds) {
    return obstacles_at({box}, time_from_seconds(seconds)).rectangles.size();
  };
  EXPECT_EQ(count(1.999), 0U);
  EXPECT_EQ(count(2.0), 1U);
  EXPECT_EQ(count(3.999), 1U);
  EXPECT_EQ(count(4.0), 0U);
  const Rectangle seen = obstacles_at({box}, time_from_seconds(3.0)).rectangles.at(0);
  EXPECT_EQ(seen.centre, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(seen.size, Eigen::Vector2d(1.0, 0.5));
  EXPECT_EQ(seen.yaw, 0.3);
}

TEST(DistanceToObstacles, IsThatOfTheNearestSurface) {
  Obstacles obstacles;
  EXPECT_GT(distance_to_obstacles(obstacles, {0.0, 0.0}), 1e6);
  obstacles.discs = {{{3.0, 4.0}, 1.0}};
  EXPECT_NEAR(distance_to_obstacles(obstacles, {0.0, 0.0}), 4.0, 1e-12);
  EXPECT_NEAR(distance_to_obstacles(obstacles, {3.0, 4.5}), -0.5, 1e-12);
  obstacles.rectangles = {{{-2.0, 0.0}, {2.0, 1.0}, kPi / 2.0}};  // x -2.5 to -1.5, y -1 to 1.
  EXPECT_NEAR(distance_to_obstacles(obstacles, {0.0, 0.0}), 1.5, 1e-12);
  EXPECT_NEAR(distance_to_obstacles(obstacles, {-1.0, 2.0}), std::hypot(0.5, 1.0), 1e-12);
  EXPECT_NEAR(distance_to_obstacles(obstacles, {-2.0, 0.9}), -0.1, 1e-12);
}

}  // namespace
}  // namespace tagfield
