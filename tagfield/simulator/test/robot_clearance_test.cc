// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/robot_clearance.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/laser/simulated_laser.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/simulator/test/small_world.h"

namespace tagfield {
namespace {

/// Computed from points on the line that are about a millimetre apart.
double distance_by_points(const RobotOutline& outline, const Eigen::Vector2d& a,
                          const Eigen::Vector2d& b) {
  double least = 1e9;
  constexpr int kPoints = 4000;
  for (int i = 0; i <= kPoints; ++i) {
    const Eigen::Vector2d p = a + (b - a) * (static_cast<double>(i) / kPoints);
    least = std::min(least, std::hypot(std::max(std::abs(p.x()) - outline.length_m / 2.0, 0.0),
                                       std::max(std::abs(p.y()) - outline.width_m / 2.0, 0.0)));
  }
  return least;
}

RC_GTEST_PROP(DistanceToLine, IsThatOfItsNearestPoint, ()) {
  const auto coordinate = [] { return *rc::gen::inRange(-150, 151) * 0.01; };
  const Eigen::Vector2d a(coordinate(), coordinate());
  const Eigen::Vector2d b(coordinate(), coordinate());
  const RobotOutline outline;
  const double exact = distance_to_line(outline, a, b);
  const double sampled = distance_by_points(outline, a, b);
  RC_ASSERT(exact <= sampled + 1e-12);
  RC_ASSERT(exact >= sampled - 1e-3);
}

RobotClearance clearance_of(const std::vector<Collision>& collisions) {
  Scene scene;
  scene.collisions = collisions;
  return {scene, RobotOutline{0.6, 0.4, 0.36}};
}

TEST(RobotClearance, IsThatFromARectangleToABox) {
  const RobotClearance clearance = clearance_of({box_at(2.0, 0.0, 1.0, 1.0)});  // From x = 1.5 on.
  // Solids are thickened by a millimetre.
  EXPECT_NEAR(clearance.distance({0.5, 0.0, 0.0}, {}), 0.7, 2e-3);
  EXPECT_NEAR(clearance.distance({0.5, 0.0, kPi / 2.0}, {}), 0.8, 2e-3);
  const double diagonal = std::hypot(0.3, 0.2);
  EXPECT_NEAR(clearance.distance({0.9, 0.0, std::atan2(0.2, 0.3)}, {}), 0.6 - diagonal, 2e-3);
  EXPECT_EQ(clearance.distance({1.25, 0.0, 0.0}, {}), 0.0);
  EXPECT_EQ(clearance.distance({-3.0, 0.0, 0.0}, {}), RobotClearance::kMost);
}

TEST(RobotClearance, MindsWhatIsAsHighAsTheRobot) {
  const RobotClearance clearance =
      clearance_of({box_at(1.0, 0.0, 0.2, 0.2, 0.0, 0.04),   // Rolled over,
                    box_at(1.0, 0.0, 0.2, 0.2, 0.5, 1.0)});  // passed beneath.
  EXPECT_EQ(clearance.distance({1.0, 0.0, 0.0}, {}), RobotClearance::kMost);
}

TEST(RobotClearance, MindsObstacles) {
  const RobotClearance clearance = clearance_of({});
  Obstacles obstacles;
  obstacles.discs = {{{1.0, 0.0}, 0.25}};
  EXPECT_NEAR(clearance.distance({0.0, 0.0, 0.0}, obstacles), 0.45, 1e-12);
  EXPECT_EQ(clearance.distance({0.6, 0.0, 0.0}, obstacles), 0.0);
  EXPECT_EQ(clearance.distance({1.0, 0.1, 0.0}, obstacles), 0.0);
  obstacles.discs.clear();
  obstacles.rectangles = {{{0.0, 2.0}, {4.0, 2.0}, 0.0}};
  EXPECT_NEAR(clearance.distance({0.0, 0.5, 0.0}, obstacles), 0.3, 1e-12);
  EXPECT_EQ(clearance.distance({0.0, 2.0, 0.0}, obstacles), 0.0);
  // A rotated square's corner points at the robot.
  obstacles.rectangles = {{{2.0, 0.0}, {1.0, 1.0}, kPi / 4.0}};
  EXPECT_NEAR(clearance.distance({0.5, 0.0, 0.0}, obstacles), 2.0 - std::sqrt(0.5) - 0.8, 1e-12);
}

TEST(RobotClearance, KnowsHowFarRobotsAreApart) {
  const RobotClearance clearance = clearance_of({});
  EXPECT_NEAR(clearance.distance_between({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0}), 0.3, 1e-12);
  EXPECT_NEAR(clearance.distance_between({0.0, 0.0, 0.0}, {0.0, 0.9, kPi / 2.0}), 0.4, 1e-12);
  for (const PlanarPose& other :
       {PlanarPose{}, PlanarPose{0.1, 0.0, 2.0}, PlanarPose{0.59, 0.3, 0.0}}) {
    EXPECT_EQ(clearance.distance_between({}, other), 0.0) << other.x;
  }
  EXPECT_EQ(clearance.distance_between({}, {9.0, 0.0, 0.0}), RobotClearance::kMost);
}

TEST(RobotClearance, RoomIsNeverGivenAsMoreThanItIs) {
  const RobotClearance clearance = clearance_of({box_at(2.0, 0.0, 1.0, 1.0)});
  for (double x = 0.0; x < 1.5; x += 0.037) {
    const double room = clearance.room_at({x, 0.1});
    EXPECT_LE(room, 1.5 - x);
    EXPECT_GE(room, 1.5 - x - 0.06);
  }
  EXPECT_EQ(clearance.room_at({1.5, 0.0}), 0.0);
}

}  // namespace
}  // namespace tagfield
