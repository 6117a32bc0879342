// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/robot_driver.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tagfield {
namespace {

using std::chrono::milliseconds;

Time at(int ms) { return Time(milliseconds(ms)); }

PathFollower straight_path() {
  return PathFollower({0.0, 0.0, 0.0}, {{2.0, 0.0}}, {0.3, 1.0, 0.5});
}

/// Drives an ideal robot, which reaches each velocity instantly, from `from` to `to` [ms].
PlanarPose drive(RobotDriver& driver, PlanarPose pose, int from, int to) {
  for (int ms = from; ms < to; ++ms) pose = advance(pose, driver.next(pose, at(ms)), 0.001);
  return pose;
}

TEST(RobotDriver, StandsWithoutCommandOrPath) {
  RobotDriver driver({});
  const PlanarPose end = drive(driver, {1.0, 2.0, 0.5}, 0, 3000);
  EXPECT_EQ(end.x, 1.0);
  EXPECT_EQ(end.y, 2.0);
  EXPECT_EQ(end.yaw, 0.5);
  EXPECT_FALSE(driver.finished());
}

TEST(RobotDriver, DrivesACommandUntilItIsTooOld) {
  RobotDriver driver({});
  ASSERT_TRUE(driver.command({0.4, 0.0}, at(0)));
  drive(driver, {}, 0, 499);
  EXPECT_NEAR(driver.next({}, at(499)).forward, 0.4, 1e-12);
  drive(driver, {}, 500, 1000);
  EXPECT_EQ(driver.next({}, at(1000)).forward, 0.0);
}

TEST(RobotDriver, ReachesTheEndOfItsPathAndStands) {
  RobotDriver driver({});
  driver.set_path(straight_path());
  const PlanarPose end = drive(driver, {}, 0, 9000);
  EXPECT_TRUE(driver.finished());
  // Stops at most v²/2a = 45 mm beyond the end, or 15 mm, one decision, before it.
  EXPECT_NEAR(end.x, 2.0, 0.05);
  EXPECT_NEAR(end.y, 0.0, 1e-9);
  EXPECT_EQ(driver.next(end, at(9000)).forward, 0.0);
}

TEST(RobotDriver, ACommandTakesOverThePathForItsTimeout) {
  RobotDriver driver({});
  driver.set_path(straight_path());
  PlanarPose pose = drive(driver, {}, 0, 2000);
  ASSERT_TRUE(driver.command({0.0, 0.0}, at(2000)));
  pose = drive(driver, pose, 2000, 2499);
  EXPECT_EQ(driver.next(pose, at(2499)).forward, 0.0);
  pose = drive(driver, pose, 2500, 12'000);
  EXPECT_TRUE(driver.finished());
  EXPECT_NEAR(pose.x, 2.0, 0.05);
}

TEST(RobotDriver, RefusesACommandThatIsNotFinite) {
  RobotDriver driver({});
  driver.set_path(straight_path());
  EXPECT_FALSE(driver.command({std::nan(""), 0.0}, at(0)));
  EXPECT_FALSE(driver.command({0.0, HUGE_VAL}, at(0)));
  drive(driver, {}, 0, 1000);
  EXPECT_NEAR(driver.next({0.2, 0.0, 0.0}, at(1000)).forward, 0.3, 1e-12);
}

}  // namespace
}  // namespace tagfield
