// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/speed_limits.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace tagfield {
namespace {

constexpr SpeedLimits kLimits{0.8, 1.5, 1.0, 3.0};

TEST(SpeedLimits, ReachesTheWantedSpeedAtItsAcceleration) {
  BodyVelocity velocity;
  int steps = 0;
  while (velocity.forward < 0.5 && steps < 10'000) {
    velocity = limited({0.5, 0.0}, velocity, kLimits, 0.001);
    ++steps;
  }
  EXPECT_EQ(velocity.forward, 0.5);
  EXPECT_NEAR(steps, 500, 1);  // 0.5 m/s at 1 m/s²
}

TEST(SpeedLimits, NeitherSpeedNorTurnExceedsItsLimit) {
  BodyVelocity velocity;
  for (int i = 0; i < 5000; ++i) velocity = limited({9.0, -9.0}, velocity, kLimits, 0.001);
  EXPECT_EQ(velocity.forward, 0.8);
  EXPECT_EQ(velocity.turn, -1.5);
}

TEST(SpeedLimits, LeavesAPossibleVelocityAlone) {
  const BodyVelocity velocity = limited({0.3, 0.2}, {0.3, 0.2}, kLimits, 0.001);
  EXPECT_EQ(velocity.forward, 0.3);
  EXPECT_EQ(velocity.turn, 0.2);
}

RC_GTEST_PROP(SpeedLimits, NeverChangesFasterThanTheAcceleration, ()) {
  const auto speed = [] { return *rc::gen::inRange(-80, 80) * 0.01; };
  const BodyVelocity present{speed(), speed()};
  const double seconds = *rc::gen::inRange(0, 100) * 0.001;
  const BodyVelocity next = limited({4.0 * speed(), 4.0 * speed()}, present, kLimits, seconds);
  RC_ASSERT(std::abs(next.forward - present.forward) <= 1.0 * seconds + 1e-12);
  RC_ASSERT(std::abs(next.turn - present.turn) <= 3.0 * seconds + 1e-12);
  RC_ASSERT(std::abs(next.forward) <= 0.8);
  RC_ASSERT(std::abs(next.turn) <= 1.5);
}

}  // namespace
}  // namespace tagfield
