// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/self_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tagfield/motion/planar_pose.h"
#include "tagfield/simulator/test/small_world.h"

namespace tagfield {
namespace {

constexpr double kDriveStep = 0.02;

const NavigationWorld& world() {
  static const NavigationWorld made = [] {
    Diagnostics diagnostics;
    return navigation_world(small_drive(), small_room(), diagnostics);
  }();
  return made;
}

NavigationSpec spec() { return navigation_of(small_drive()); }

PoseEstimate about(const PlanarPose& pose) {
  return {pose, Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal()};
}

/// A robot that drives by itself on the true map, and how close it comes to anything.
struct Ride {
  Ride(const PlanarPose& start, const std::optional<PoseEstimate>& given,
       const std::vector<PlanarPose>& goals)
      : driver(spec(), 0.4, world(), world().true_map, nullptr, given, goals, 3, 1), truth(start) {}

  void step() {
    const BodyVelocity velocity =
        driver.step(truth, time_from_seconds(count * kDriveStep), kDriveStep);
    truth = advance(truth, velocity, kDriveStep);
    was_lost = was_lost || !driver.knows_position();
    nearest_m = std::min(nearest_m, world().clearance.distance(truth, {}));
    ++count;
  }
  void run(double max_s) {
    while (!driver.finished() && count * kDriveStep < max_s) step();
  }
  [[nodiscard]] double error_m() const {
    return (position_of(driver.believed(kDriveStep).pose_M) - position_of(truth)).norm();
  }

  SelfDriver driver;
  PlanarPose truth;
  double nearest_m = 1.0;
  bool was_lost = false;
  int count = 0;
};

TEST(GoalsAt, LookAlongTheWay) {
  const auto goals = goals_at({1.0, 0.0, 0.3}, {{1.0, 0.0}, {1.0, 2.0}, {0.0, 1.0}});
  ASSERT_EQ(goals.size(), 3U);
  EXPECT_EQ(goals[0].yaw, 0.3);  // Nowhere to go: the heading stays.
  EXPECT_NEAR(goals[1].yaw, kPi / 2.0, 1e-12);
  EXPECT_NEAR(goals[2].yaw, -3.0 * kPi / 4.0, 1e-12);
  EXPECT_EQ(goals[2].x, 0.0);
}

TEST(SelfDriver, DrivesToOneGoalAfterAnother) {
  const std::vector<PlanarPose> goals{{1.5, 0.5, 0.0}, {0.0, -1.0, 1.0}};
  Ride ride({}, about({}), goals);
  EXPECT_TRUE(ride.driver.knows_position());
  ride.run(60.0);
  ASSERT_EQ(ride.driver.outcomes().size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const GoalOutcome& outcome = ride.driver.outcomes()[i];
    EXPECT_EQ(outcome.state, DriveState::kReached) << outcome.reason;
    EXPECT_LT((position_of(outcome.truth_W) - position_of(goals[i])).norm(), 0.1);
    EXPECT_LT(std::abs(wrap_to_pi(outcome.truth_W.yaw - goals[i].yaw)), 0.1);
    // Not faster than 0.4 m/s, and without too much time for turns.
    EXPECT_GT(outcome.seconds, 1.5 / 0.4);
    EXPECT_LT(outcome.seconds, 25.0);
  }
  EXPECT_GT(ride.nearest_m, 0.0);
  EXPECT_EQ(ride.driver.progress(), 1.0);
  EXPECT_EQ(ride.driver.step(ride.truth, time_from_seconds(61.0), kDriveStep).turn, 0.0);
}

TEST(SelfDriver, GoesOnWhereAGoalIsRefused) {
  Ride ride({}, about({}), {{9.0, 0.0, 0.0}, {2.9, 0.0, 0.0}, {0.5, 0.0, 0.0}});
  ride.run(30.0);
  ASSERT_EQ(ride.driver.outcomes().size(), 3U);
  EXPECT_EQ(ride.driver.outcomes()[0].state, DriveState::kRefused);
  EXPECT_NE(ride.driver.outcomes()[0].reason.find("off the map"), std::string::npos);
  EXPECT_EQ(ride.driver.outcomes()[1].state, DriveState::kRefused);
  EXPECT_NE(ride.driver.outcomes()[1].reason.find("to an obstacle"), std::string::npos);
  EXPECT_EQ(ride.driver.outcomes()[2].state, DriveState::kReached);
}

TEST(SelfDriver, FindsItselfFirstWhereNoPoseWasGiven) {
  Ride ride({1.2, -0.8, 2.0}, std::nullopt, {{-1.0, 0.5, 0.0}});
  EXPECT_FALSE(ride.driver.knows_position());
  ride.run(90.0);
  ASSERT_EQ(ride.driver.outcomes().size(), 1U);
  EXPECT_EQ(ride.driver.outcomes()[0].state, DriveState::kReached)
      << ride.driver.outcomes()[0].reason;
  EXPECT_TRUE(ride.driver.knows_position());
  EXPECT_LT(ride.error_m(), 0.05);
  EXPECT_GT(ride.nearest_m, 0.0);
}

TEST(SelfDriver, FindsItselfAgainWhenCarriedAway) {
  Ride ride({-1.5, -1.0, 0.0}, about({-1.5, -1.0, 0.0}),
            {{1.5, -1.0, 0.0}, {-1.0, 1.0, 0.0}, {1.5, 0.0, 0.0}});
  while (ride.count * kDriveStep < 4.0) ride.step();
  ride.truth = {1.5, 0.8, -2.0};
  ride.run(120.0);
  ASSERT_TRUE(ride.driver.finished());
  EXPECT_TRUE(ride.was_lost);
  EXPECT_EQ(ride.driver.outcomes().back().state, DriveState::kReached);
  EXPECT_LT(ride.error_m(), 0.05);
  EXPECT_GT(ride.nearest_m, 0.0);
}

/// On the map of another place no pose can be found: the robot gives up, with a reason.
TEST(SelfDriver, GivesUpSearchingInTheEnd) {
  OccupancyGrid elsewhere;
  elsewhere.width = elsewhere.height = 100;
  elsewhere.cells.assign(10'000, 0);
  elsewhere.cells[elsewhere.index(50, 50)] = 100;
  NavigationSpec navigation = spec();
  navigation.laser.rate_hz = 2.0;
  navigation.localizer.first_particles = 300;
  navigation.localizer.min_searching = 200;
  navigation.localizer.update_turn_rad = 3.0;
  navigation.localizer.update_distance_m = 3.0;
  SelfDriver driver(navigation, 0.4, world(), elsewhere, nullptr, std::nullopt,
                    {{}, {1.0, 0.0, 0.0}}, 1, 1);
  constexpr double kLong = 0.1;
  PlanarPose truth;
  double now = 0.0;
  for (; !driver.finished() && now < 400.0; now += kLong) {
    truth = advance(truth, driver.step(truth, time_from_seconds(now), kLong), kLong);
  }
  EXPECT_NEAR(now, SelfDriver::kSearchLimit_s, 1.0);
  ASSERT_EQ(driver.outcomes().size(), 2U);
  EXPECT_EQ(driver.outcomes()[1].state, DriveState::kFailed);
  EXPECT_EQ(driver.outcomes()[1].reason, "the robot does not know where it is");
}

}  // namespace
}  // namespace tagfield
