// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/unicycle.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

TEST(BodyVelocity, FollowsEquationsSevenAndEight) {
  const DriveGeometry drive{0.1, 0.5};
  const BodyVelocity velocity = body_velocity(drive, {2.0, 4.0});
  EXPECT_DOUBLE_EQ(velocity.forward, 0.1 * (4.0 + 2.0) / 2.0);
  EXPECT_DOUBLE_EQ(velocity.turn, 0.1 * (4.0 - 2.0) / 0.5);
}

RC_GTEST_PROP(WheelSpeeds, AreTheInverseOfBodyVelocity, ()) {
  const DriveGeometry drive{*rc::gen::inRange(1, 50) * 0.01, *rc::gen::inRange(10, 200) * 0.01};
  const BodyVelocity wanted{*rc::gen::inRange(-200, 200) * 0.01,
                            *rc::gen::inRange(-300, 300) * 0.01};
  const BodyVelocity velocity = body_velocity(drive, wheel_speeds(drive, wanted));
  RC_ASSERT(std::abs(velocity.forward - wanted.forward) < 1e-12);
  RC_ASSERT(std::abs(velocity.turn - wanted.turn) < 1e-12);
}

TEST(Advance, DrivesAQuarterCircle) {
  // Radius v/ω = 2 m: a quarter turn to the left, starting at the origin along x, ends at (2, 2).
  const PlanarPose end = advance({0.0, 0.0, 0.0}, {1.0, 0.5}, kPi);
  EXPECT_NEAR(end.x, 2.0, 1e-12);
  EXPECT_NEAR(end.y, 2.0, 1e-12);
  EXPECT_NEAR(end.yaw, kPi / 2.0, 1e-12);
}

/// Eq. (6) by many small Euler steps.
PlanarPose by_euler(PlanarPose pose, const BodyVelocity& velocity, double seconds) {
  constexpr int kSteps = 200'000;
  const double dt = seconds / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    pose.x += std::cos(pose.yaw) * velocity.forward * dt;
    pose.y += std::sin(pose.yaw) * velocity.forward * dt;
    pose.yaw += velocity.turn * dt;
  }
  return pose;
}

TEST(Advance, AgreesWithEulerIntegrationOfEquationSix) {
  for (const double turn : {-1.5, -1e-8, 0.0, 1e-4, 0.7}) {
    const PlanarPose start{1.0, -2.0, 0.4};
    const PlanarPose exact = advance(start, {0.6, turn}, 1.7);
    const PlanarPose euler = by_euler(start, {0.6, turn}, 1.7);
    EXPECT_NEAR(exact.x, euler.x, 2e-5) << turn;
    EXPECT_NEAR(exact.y, euler.y, 2e-5) << turn;
    EXPECT_NEAR(exact.yaw, euler.yaw, 1e-9) << turn;
  }
}

RC_GTEST_PROP(Advance, InTwoPartsIsTheSameAsInOne, ()) {
  const BodyVelocity velocity{*rc::gen::inRange(-100, 100) * 0.01,
                              *rc::gen::inRange(-300, 300) * 0.01};
  const double first = *rc::gen::inRange(0, 1000) * 1e-3;
  const double second = *rc::gen::inRange(0, 1000) * 1e-3;
  const PlanarPose at_once = advance({}, velocity, first + second);
  const PlanarPose in_parts = advance(advance({}, velocity, first), velocity, second);
  RC_ASSERT(std::hypot(at_once.x - in_parts.x, at_once.y - in_parts.y) < 1e-9);
}

}  // namespace
}  // namespace tagfield
