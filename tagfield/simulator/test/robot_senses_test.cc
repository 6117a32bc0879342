// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/robot_senses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/motion/planar_pose.h"
#include "tagfield/simulator/test/small_world.h"

namespace tagfield {
namespace {

constexpr double kStep = 0.02;

LaserWorld room() { return {std::make_shared<const RayScene>(small_room()), {}}; }

LaserParameters exact_laser() {
  LaserParameters laser;
  laser.beams = 181;
  laser.sigma_m = 0.0;
  laser.rate_hz = 10.0;
  return laser;
}

const OdometryNoise kNoNoise{0.0, 0.0, 0.0, 0.0};

Time at(double seconds) { return time_from_seconds(seconds); }

TEST(RobotSenses, WheelsTellTheWayFromTheirStart) {
  RobotSenses senses(room(), exact_laser(), kNoNoise, 1, 1);
  const PlanarPose start{-1.0, 0.5, 0.4};
  const BodyVelocity velocity{0.3, 0.2};
  PlanarPose truth = start;
  EXPECT_EQ(senses.present_seconds(), 0.0);
  for (int i = 0; i < 100; ++i) {
    senses.step(truth, velocity, at(i * kStep), kStep);
    truth = advance(truth, velocity, kStep);
  }
  const PlanarPose way = senses.odometry(senses.present_seconds());
  const PlanarPose true_way = between(start, truth);
  EXPECT_NEAR(way.x, true_way.x, 1e-9);
  EXPECT_NEAR(way.y, true_way.y, 1e-9);
  EXPECT_NEAR(way.yaw, true_way.yaw, 1e-9);
}

/// 2 m straight ahead, many times: the distance has a standard error of α3·√2.
TEST(RobotSenses, WheelsErrAsStated) {
  const OdometryNoise noise{0.0, 0.0, 0.05, 0.0};
  double squares = 0.0;
  constexpr int kRuns = 200;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    LaserParameters laser = exact_laser();
    laser.rate_hz = 0.1;
    RobotSenses senses(room(), laser, noise, run, 1);
    for (int i = 1; i <= 20; ++i) {
      senses.step({0.1 * i, 0.0, 0.0}, {0.5, 0.0}, at(0.2 * i), 0.2);
    }
    squares += std::pow(senses.odometry(0.2).x - 2.0, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / kRuns), 0.05 * std::sqrt(2.0), 0.012);
}

TEST(RobotSenses, ScansComeAtTheirRateWithTheWheelsThen) {
  RobotSenses senses(room(), exact_laser(), kNoNoise, 1, 1);
  PlanarPose truth{0.0, 0.0, 0.0};
  std::vector<SensedScan> scans;
  for (int i = 0; i < 50; ++i) {
    const auto more = senses.step(truth, {0.5, 0.0}, at(i * kStep), kStep);
    scans.insert(scans.end(), more.begin(), more.end());
    truth = advance(truth, {0.5, 0.0}, kStep);
  }
  ASSERT_EQ(scans.size(), 10U);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const double t = 0.1 * static_cast<double>(i);
    EXPECT_EQ(scans[i].scan.stamp, at(t));
    EXPECT_NEAR(scans[i].odometry.x, 0.5 * t, 1e-9);
    // The middle beam meets the wall at x = 3; the laser is 0.15 m ahead of the base.
    EXPECT_NEAR(scans[i].scan.ranges_m[90], 3.0 - 0.15 - 0.5 * t, 1e-4);
  }
}

/// A scan swept while the robot turns is converted to a single instant.
TEST(RobotSenses, StraightenSweptScans) {
  LaserParameters laser = exact_laser();
  laser.sweep_s = 0.05;
  RobotSenses senses(room(), laser, kNoNoise, 1, 1);
  PlanarPose truth{0.0, 0.0, 0.0};
  const BodyVelocity turning{0.0, 1.0};
  std::vector<SensedScan> scans;
  for (int i = 0; i < 50; ++i) {
    const auto more = senses.step(truth, turning, at(i * kStep), kStep);
    scans.insert(scans.end(), more.begin(), more.end());
    truth = advance(truth, turning, kStep);
  }
  ASSERT_GE(scans.size(), 9U);
  const RayScene rays(small_room());
  laser.sweep_s = 0.0;
  const RigidTransform X_WR = to_transform({0.0, 0.0, to_seconds(scans[5].scan.stamp)});
  const LaserScan still = simulate_scan(
      rays, laser, 0, [&](Time) { return X_WR; }, nullptr, 1, 1);
  int alike = 0;
  for (std::size_t i = 0; i < still.ranges_m.size(); ++i) {
    const float off = scans[5].scan.ranges_m[i] - still.ranges_m[i];
    alike += static_cast<int>(std::abs(off) < 0.03F);
  }
  // Beams at edges, and those that rotated out of view, differ.
  EXPECT_GT(alike, 150);
}

/// Kidnapped between two steps: seen by the laser, not by the odometry.
TEST(RobotSenses, WheelsDontNoticeAKidnapping) {
  RobotSenses senses(room(), exact_laser(), kNoNoise, 1, 1);
  senses.step({0.0, 0.0, 0.0}, {0.0, 0.0}, at(0.0), 0.05);
  senses.step({0.0, 0.0, 0.0}, {0.0, 0.0}, at(0.05), 0.05);
  const auto scans = senses.step({1.0, 0.0, 0.0}, {0.0, 0.0}, at(0.1), 0.05);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_NEAR(scans[0].scan.ranges_m[90], 3.0 - 0.15 - 1.0, 1e-4);
  EXPECT_NEAR(senses.odometry(0.05).x, 0.0, 1e-12);
}

TEST(RobotSenses, SeeObstacles) {
  LaserWorld world = room();
  ObstacleSpec somebody;
  somebody.radius_m = 0.25;
  somebody.motion = {{Time{}, from_translation({2.0, 0.0, 0.0})}};
  somebody.appears = at(0.05);
  world.obstacles = {somebody};
  RobotSenses senses(world, exact_laser(), kNoNoise, 1, 1);
  const auto before = senses.step({}, {}, at(0.0), 0.05);
  senses.step({}, {}, at(0.05), 0.05);
  const auto after = senses.step({}, {}, at(0.1), 0.05);
  ASSERT_EQ(before.size(), 1U);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_NEAR(before[0].scan.ranges_m[90], 2.85, 1e-4);
  EXPECT_NEAR(after[0].scan.ranges_m[90], 2.0 - 0.25 - 0.15, 1e-4);
}

TEST(RobotSenses, RefuseAnImpossibleLaser) {
  LaserParameters laser;
  laser.beams = 1;
  EXPECT_THROW(RobotSenses(room(), laser, {}, 1, 1), Error);
  EXPECT_THROW(RobotSenses(room(), {}, {-1.0, 0.0, 0.0, 0.0}, 1, 1), Error);
}

}  // namespace
}  // namespace tagfield
