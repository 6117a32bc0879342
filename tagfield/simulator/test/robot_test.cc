// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/robot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tagfield {
namespace {

RobotSpec l_shaped_drive() {
  RobotSpec spec;
  spec.name = "robot";
  spec.waypoints = {{2.0, 0.0}, {2.0, 2.0}};
  return spec;
}

void drive_to_the_end(Robot& robot) {
  for (int i = 0; i < 100'000 && !robot.finished(); ++i) robot.step({}, 0.01);
  ASSERT_TRUE(robot.finished());
}

TEST(Robot, KnowsItsTruePoseBetweenSteps) {
  Robot robot(l_shaped_drive(), PoseBelief{}, 1);
  for (int i = 0; i < 50; ++i) robot.step({}, 0.01);
  // Straight ahead at 0.3 m/s for 49 whole steps and half of the fiftieth.
  EXPECT_NEAR(robot.true_pose(0.005).translation.x(), 0.3 * 0.495, 1e-9);
  EXPECT_NEAR(robot.travelled_m(), 0.3 * 0.5, 1e-9);
}

TEST(Robot, BelievesTheTruthIfConfiguredSo) {
  Robot robot(l_shaped_drive(), PoseBelief{}, 1);
  drive_to_the_end(robot);
  EXPECT_TRUE(robot.true_pose(0.01).translation.isApprox(robot.believed_pose(0.01).translation));
}

TEST(Robot, BelievesOdometryWithoutNoiseExactly) {
  PoseBelief belief;
  belief.source = PoseSource::kOdometry;
  belief.wheel_noise = 0.0;
  Robot robot(l_shaped_drive(), belief, 1);
  drive_to_the_end(robot);
  EXPECT_LT((robot.true_pose(0.0).translation - robot.believed_pose(0.0).translation).norm(), 1e-9);
}

TEST(Robot, OdometryDriftsWithNoise) {
  PoseBelief belief;
  belief.source = PoseSource::kOdometry;
  belief.wheel_noise = 0.005;
  Robot robot(l_shaped_drive(), belief, 1);
  drive_to_the_end(robot);
  const double drift =
      (robot.true_pose(0.0).translation - robot.believed_pose(0.0).translation).norm();
  EXPECT_GT(drift, 1e-4);
  EXPECT_LT(drift, 0.5);
}

TEST(Robot, NoisyBeliefIsContinuous) {
  PoseBelief belief;
  belief.source = PoseSource::kNoisy;
  belief.sigma_m = 0.05;
  Robot robot(l_shaped_drive(), belief, 3);
  robot.step({}, 0.01);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d end = robot.believed_pose(0.01).translation;
    robot.step({}, 0.01);
    EXPECT_LT((robot.believed_pose(0.0).translation - end).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace tagfield
