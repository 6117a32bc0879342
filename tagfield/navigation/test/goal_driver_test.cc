// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/goal_driver.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/base/error.h"
#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::BoxWorld;
using testing::DriveSimulation;
using testing::kLaser;
using testing::simulation_in;
using testing::walls;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A hall of 10 m by 6 m with a block in the middle.
const BoxWorld& hall() {
  static const BoxWorld world = [] {
    auto boxes = walls({0.0, 0.0}, {10.0, 6.0});
    boxes.push_back({{4.5, 2.5}, {5.5, 3.5}});
    return BoxWorld(boxes, {1.0, 1.0});
  }();
  return world;
}

GoalDriver driver_in(const BoxWorld& world, const GoalDriverSettings& settings = {}) {
  GoalDriver driver(settings, kLaser);
  driver.set_map(world.map);
  return driver;
}

double error_of(const PlanarPose& pose, const PlanarPose& goal) {
  return std::hypot(pose.x - goal.x, pose.y - goal.y);
}

struct Refusal {
  PlanarPose goal;
  const char* word;
};

TEST(GoalDriver, RefusesWithAReason) {
  const std::vector<Refusal> refusals = {
      {{100.0, 1.0, 0.0}, "off the map"},     {{kNan, 1.0, 0.0}, "not finite"},
      {{1.0, 1.0, HUGE_VAL}, "not finite"},   {{4.51, 3.0, 0.0}, "on an obstacle"},
      {{5.0, 3.0, 0.0}, "on unknown ground"}, {{0.3, 3.0, 0.0}, "nearer than 0.41 m"},
  };
  for (const Refusal& refusal : refusals) {
    GoalDriver driver = driver_in(hall());
    driver.set_goal(refusal.goal, {1.0, 1.0, 0.0}, Time{});
    EXPECT_EQ(driver.state(), DriveState::kRefused);
    EXPECT_NE(driver.reason().find(refusal.word), std::string::npos) << driver.reason();
    EXPECT_EQ(driver.reason().find('\n'), std::string::npos);
    EXPECT_TRUE(driver.path().empty());
    const BodyVelocity command = driver.next({1.0, 1.0, 0.0}, {}, Time{});
    EXPECT_EQ(command.forward, 0.0);
    EXPECT_EQ(command.turn, 0.0);
  }
}

TEST(GoalDriver, RefusesWhereTheRobotIsWrong) {
  const std::vector<Refusal> refusals = {{{4.5, 3.0, 0.0}, "in an obstacle"},
                                         {{0.05, 3.0, 0.0}, "in an obstacle"},
                                         {{-50.0, 3.0, 0.0}, "off the map"},
                                         {{1.0, kNan, 0.0}, "not finite"}};
  for (const Refusal& refusal : refusals) {
    GoalDriver driver = driver_in(hall());
    driver.set_goal({8.0, 1.0, 0.0}, refusal.goal, Time{});
    EXPECT_EQ(driver.state(), DriveState::kRefused);
    EXPECT_NE(driver.reason().find(refusal.word), std::string::npos) << driver.reason();
  }
}

TEST(GoalDriver, RefusesWhereThereIsNoWay) {
  // A wall across the hall with a gap of 0.7 m, too narrow for the robot's circle of 0.82 m.
  auto boxes = walls({0.0, 0.0}, {10.0, 6.0});
  boxes.push_back({{5.0, 0.0}, {5.2, 3.0}});
  boxes.push_back({{5.0, 3.7}, {5.2, 6.0}});
  const BoxWorld world(boxes, {1.0, 1.0});
  GoalDriver driver = driver_in(world);
  driver.set_goal({8.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, Time{});
  EXPECT_EQ(driver.state(), DriveState::kRefused);
  EXPECT_NE(driver.reason().find("no path"), std::string::npos) << driver.reason();
}

TEST(GoalDriver, NeedsAMap) {
  GoalDriver driver({}, kLaser);
  driver.set_goal({1.0, 1.0, 0.0}, {}, Time{});
  EXPECT_EQ(driver.state(), DriveState::kRefused);
  EXPECT_THROW(driver.set_map({}), Error);
  OccupancyGrid torn = hall().map;
  torn.cells.pop_back();
  EXPECT_THROW(driver.set_map(torn), Error);
}

TEST(GoalDriver, RefusesSettingsThatMakeNoSense) {
  GoalDriverSettings settings;
  settings.rate_hz = 0.0;
  EXPECT_THROW(GoalDriver(settings, kLaser), Error);
  settings = {};
  settings.margin_m = -0.1;
  EXPECT_THROW(GoalDriver(settings, kLaser), Error);
  settings = {};
  settings.limits.acceleration_m_s2 = kNan;
  EXPECT_THROW(GoalDriver(settings, kLaser), Error);
  settings = {};
  settings.margin_m = 0.0;
  settings.clearance_m = 0.0;
  EXPECT_NO_THROW(GoalDriver(settings, kLaser));
}

TEST(GoalDriver, ReachesGoalsAroundACornerAndOnTheSpot) {
  const std::vector<PlanarPose> goals = {
      {8.0, 3.0, 1.0}, {2.0, 3.0, -2.0}, {2.0, 3.0, 2.0}, {1.9, 3.0, 2.0}, {2.0, 3.0, 2.0}};
  PlanarPose pose{2.0, 3.0, 3.0};
  for (const PlanarPose& goal : goals) {
    GoalDriver driver = driver_in(hall());
    DriveSimulation simulation = simulation_in(hall(), pose);
    driver.set_goal(goal, pose, simulation.now());
    simulation.run(driver, 90.0);
    ASSERT_EQ(driver.state(), DriveState::kReached) << driver.reason();
    EXPECT_LT(error_of(simulation.pose, goal), 0.05);
    EXPECT_LT(std::abs(wrap_to_pi(simulation.pose.yaw - goal.yaw)), 0.05);
    EXPECT_GT(simulation.min_distance_m, 0.1);
    pose = simulation.pose;
  }
}

TEST(GoalDriver, StaysWithinTheDrivesLimits) {
  GoalDriverSettings settings;
  settings.limits = {0.5, 0.8, 0.4, 1.5};
  settings.speed_m_s = 0.4;
  GoalDriver driver = driver_in(hall(), settings);
  DriveSimulation simulation = simulation_in(hall(), {2.0, 3.0, 3.0});
  driver.set_goal({8.0, 3.0, 1.0}, simulation.pose, simulation.now());
  const LaserParameters laser;
  BodyVelocity velocity;
  double fastest = 0.0;
  for (int i = 0; i < 1200 && driver.state() == DriveState::kDriving; ++i) {
    // Decisions and scans are in step, at 20 Hz; the command is executed as it is.
    const RigidTransform X_WR = to_transform(simulation.pose);
    LaserScan scan = simulate_scan(
        hall().rays, laser, i, [&](Time) { return X_WR; }, nullptr, 1, 1);
    const Time now = time_from_seconds(0.05 * i);
    scan.stamp = now;
    driver.see(scan, simulation.pose);
    const BodyVelocity command = driver.next(simulation.pose, velocity, now);
    if (driver.state() != DriveState::kDriving) break;
    EXPECT_LE(std::abs(command.forward - velocity.forward), 0.4 * 0.05 + 1e-9);
    EXPECT_LE(std::abs(command.turn - velocity.turn), 1.5 * 0.05 + 1e-9);
    EXPECT_LE(std::abs(command.turn), 0.8 + 1e-9);
    velocity = command;
    fastest = std::max(fastest, velocity.forward);
    simulation.pose = advance(simulation.pose, velocity, 0.05);
  }
  EXPECT_EQ(driver.state(), DriveState::kReached);
  EXPECT_LE(fastest, 0.4 + 1e-9);
  EXPECT_GT(fastest, 0.39);
}

TEST(GoalDriver, SameCallsGiveTheSameMotion) {
  std::vector<PlanarPose> ends;
  for (int run = 0; run < 2; ++run) {
    GoalDriver driver = driver_in(hall());
    DriveSimulation simulation = simulation_in(hall(), {2.0, 3.0, 3.0});
    driver.set_goal({8.0, 3.0, 1.0}, simulation.pose, simulation.now());
    simulation.run(driver, 20.0);
    ends.push_back(simulation.pose);
  }
  EXPECT_EQ(ends[0].x, ends[1].x);
  EXPECT_EQ(ends[0].y, ends[1].y);
  EXPECT_EQ(ends[0].yaw, ends[1].yaw);
}

TEST(GoalDriver, LetsItselfOutFromNearAWall) {
  // Nearer than radius and margin, yet the footprint is free: parallel to the wall, facing it, at
  // an angle.
  for (const PlanarPose& start :
       {PlanarPose{3.0, 0.33, 0.0}, PlanarPose{3.0, 0.31, kPi}, PlanarPose{3.0, 0.3, -kPi / 2.0},
        PlanarPose{3.0, 0.36, 1.0}, PlanarPose{3.0, 0.3, kPi / 2.0}}) {
    GoalDriver driver = driver_in(hall());
    DriveSimulation simulation = simulation_in(hall(), start);
    driver.set_goal({8.0, 1.0, 0.0}, simulation.pose, simulation.now());
    simulation.run(driver, 90.0);
    EXPECT_EQ(driver.state(), DriveState::kReached) << start.yaw << driver.reason();
    EXPECT_GT(simulation.min_distance_m, 0.0) << start.yaw;
  }
}

TEST(GoalDriver, DoesNotDriveWithoutScans) {
  GoalDriverSettings settings;
  settings.patience_s = 5.0;
  GoalDriver driver = driver_in(hall(), settings);
  driver.set_goal({8.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, Time{});
  for (int i = 0; i < 200; ++i) {
    const BodyVelocity command = driver.next({1.0, 1.0, 0.0}, {}, time_from_seconds(0.05 * i));
    EXPECT_EQ(command.forward, 0.0);
    EXPECT_EQ(command.turn, 0.0);
  }
  EXPECT_EQ(driver.state(), DriveState::kFailed);
  EXPECT_NE(driver.reason().find("no laser scan"), std::string::npos) << driver.reason();
}

/// Drives for 4 s, then passes each scan to `spoil`. Returns how far the robot drives after another
/// second.
double driven_after(const std::function<void(LaserScan&)>& spoil) {
  GoalDriver driver = driver_in(hall());
  DriveSimulation simulation = simulation_in(hall(), {1.0, 1.0, 0.0});
  driver.set_goal({8.0, 1.0, 0.0}, simulation.pose, simulation.now());
  simulation.run(driver, 4.0);
  EXPECT_GT(simulation.velocity.forward, 0.25);
  double driven = 0.0;
  for (int i = 0; i < 600; ++i) {
    if (i == 60) driven = simulation.driven_m;
    if (i % 2 == 0) {
      const RigidTransform X_WR = to_transform(simulation.pose);
      LaserScan scan = simulate_scan(
          hall().rays, simulation.laser, simulation.step / 2, [&](Time) { return X_WR; }, nullptr,
          1, 1);
      spoil(scan);
      driver.see(scan, simulation.pose);
    }
    const BodyVelocity wanted = driver.next(simulation.pose, simulation.velocity, simulation.now());
    simulation.velocity = limited(wanted, simulation.velocity, simulation.limits, 1.0 / 60.0);
    simulation.pose = advance(simulation.pose, simulation.velocity, 1.0 / 60.0);
    simulation.driven_m += std::abs(simulation.velocity.forward) / 60.0;
    EXPECT_TRUE(std::isfinite(simulation.pose.x));
    ++simulation.step;
  }
  return simulation.driven_m - driven;
}

TEST(GoalDriver, StopsWhenTheLaserFails) {
  EXPECT_GT(driven_after([](LaserScan&) {}), 1.0);  // It would drive on.
  EXPECT_LT(driven_after([](LaserScan& scan) {
              std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), 0.0F);
            }),
            0.01);
  EXPECT_LT(driven_after([](LaserScan& scan) {
              std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), std::nanf(""));
            }),
            0.01);
  EXPECT_LT(driven_after([](LaserScan& scan) { scan.ranges_m.clear(); }), 0.01);
  EXPECT_LT(driven_after([](LaserScan& scan) { scan.angle_step_rad = kNan; }), 0.01);
  EXPECT_LT(driven_after([](LaserScan& scan) { scan.stamp -= std::chrono::hours(1); }), 0.01);
}

TEST(GoalDriver, DoesNotDriveIntoWhatItsLaserIsTooNearToSee) {
  // A row of invalid beams straight ahead.
  EXPECT_LT(driven_after([](LaserScan& scan) {
              std::fill(scan.ranges_m.begin() + 300, scan.ranges_m.begin() + 420, 0.0F);
            }),
            0.3);
  // Single invalid beams mean nothing.
  EXPECT_GT(driven_after([](LaserScan& scan) {
              for (std::size_t i = 0; i < scan.ranges_m.size(); i += 7) scan.ranges_m[i] = 0.0F;
            }),
            1.0);
}

TEST(GoalDriver, BearsPosesAndVelocitiesThatAreNotFinite) {
  GoalDriver driver = driver_in(hall());
  DriveSimulation simulation = simulation_in(hall(), {1.0, 1.0, 0.0});
  driver.set_goal({8.0, 1.0, 0.0}, simulation.pose, simulation.now());
  simulation.run(driver, 4.0);
  const RigidTransform X_WR = to_transform(simulation.pose);
  const LaserScan scan = simulate_scan(
      hall().rays, simulation.laser, simulation.step / 2, [&](Time) { return X_WR; }, nullptr, 1,
      1);
  driver.see(scan, {kNan, 1.0, 0.0});
  for (int i = 0; i < 40; ++i) {
    const Time now = simulation.now() + std::chrono::milliseconds(50 * i);
    const BodyVelocity command = driver.next({kNan, 1.0, HUGE_VAL}, {kNan, kNan}, now);
    EXPECT_TRUE(std::isfinite(command.forward) && std::isfinite(command.turn));
    if (i > 20) {
      EXPECT_EQ(command.forward, 0.0);
    }
  }
  EXPECT_EQ(driver.state(), DriveState::kDriving);
}

TEST(GoalDriver, GoesOnWhenTimeGoesBack) {
  GoalDriver driver = driver_in(hall());
  DriveSimulation simulation = simulation_in(hall(), {1.0, 1.0, 0.0});
  driver.set_goal({8.0, 1.0, 0.0}, simulation.pose, simulation.now());
  simulation.run(driver, 8.0);
  simulation.step = 0;
  simulation.run(driver, 60.0);
  EXPECT_EQ(driver.state(), DriveState::kReached) << driver.reason();
  EXPECT_LT(error_of(simulation.pose, {8.0, 1.0, 0.0}), 0.05);
}

TEST(GoalDriver, CancelAndNewGoals) {
  GoalDriver driver = driver_in(hall());
  EXPECT_EQ(driver.state(), DriveState::kIdle);
  driver.set_goal({8.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, Time{});
  EXPECT_EQ(driver.state(), DriveState::kDriving);
  EXPECT_FALSE(driver.path().empty());
  driver.cancel();
  EXPECT_EQ(driver.state(), DriveState::kIdle);
  EXPECT_TRUE(driver.path().empty());
  driver.set_goal({kNan, 1.0, 0.0}, {1.0, 1.0, 0.0}, Time{});
  EXPECT_EQ(driver.state(), DriveState::kRefused);
  driver.set_goal({8.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, Time{});
  EXPECT_EQ(driver.state(), DriveState::kDriving);
  EXPECT_EQ(driver.reason(), "");
  GoalDriver moved = std::move(driver);
  EXPECT_EQ(moved.state(), DriveState::kDriving);
}

RC_GTEST_PROP(GoalDriverProperties, WaysEndAtTheGoalAndKeepClear, ()) {
  const auto draw = [](double most) { return *rc::gen::inRange(0, 100'000) * most / 100'000.0; };
  const PlanarPose start{draw(10.0), draw(6.0), draw(6.0)};
  const PlanarPose goal{draw(10.0), draw(6.0), draw(6.0)};
  GoalDriver driver = driver_in(hall());
  driver.set_goal(goal, start, Time{});
  if (driver.state() == DriveState::kRefused) {
    RC_ASSERT(!driver.reason().empty());
    return;
  }
  RC_ASSERT(driver.state() == DriveState::kDriving);
  const auto& way = driver.path();
  RC_ASSERT((way.front() - position_of(start)).norm() < 1e-9);
  RC_ASSERT((way.back() - position_of(goal)).norm() < 1e-9);
  const double start_room = 0.41;
  for (std::size_t i = 1; i < way.size(); ++i) {
    for (int k = 0; k <= 50; ++k) {
      const Eigen::Vector2d p = way[i - 1] + (way[i] - way[i - 1]) * (k / 50.0);
      if ((p - position_of(start)).norm() < 2.0 * start_room) continue;
      // Distances by the hall's true geometry, not the grid: the walls and the block.
      const Eigen::Vector2d to_block =
          ((p - Eigen::Vector2d(5.0, 3.0)).cwiseAbs() - Eigen::Vector2d(0.5, 0.5)).cwiseMax(0.0);
      RC_ASSERT(std::min({p.x(), p.y(), 10.0 - p.x(), 6.0 - p.y()}) > 0.41 - 0.075);
      RC_ASSERT(to_block.norm() > 0.41 - 0.075);
    }
  }
}

}  // namespace
}  // namespace tagfield
