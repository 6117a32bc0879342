// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kHuge = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();

double any_angle() {
  const double size = std::pow(10.0, *rc::gen::inRange(-320, 309));
  return size * (*rc::gen::inRange(-1000, 1001)) / 1000.0;
}

TEST(WrapToTwoPi, KeepsWhatIsInside) {
  for (const double angle : {0.0, 1e-300, 1.0, kPi, std::nextafter(kTwoPi, 0.0)}) {
    EXPECT_EQ(wrap_to_two_pi(angle), angle);
  }
}

TEST(WrapToTwoPi, TakesOffWholeTurns) {
  EXPECT_NEAR(wrap_to_two_pi(-1.0), kTwoPi - 1.0, 1e-15);
  EXPECT_NEAR(wrap_to_two_pi(3.0 * kTwoPi + 1.0), 1.0, 1e-14);
  EXPECT_EQ(wrap_to_two_pi(kTwoPi), 0.0);
  EXPECT_EQ(wrap_to_two_pi(-kTwoPi), 0.0);
}

TEST(WrapToTwoPi, NeverReachesTwoPi) {
  for (const double angle : {-kTiny, -1e-300, -1e-17, -4e-16, std::nextafter(kTwoPi, 10.0)}) {
    EXPECT_GE(wrap_to_two_pi(angle), 0.0) << angle;
    EXPECT_LT(wrap_to_two_pi(angle), kTwoPi) << angle;
  }
}

TEST(WrapToTwoPi, GivesPlainZero) {
  EXPECT_FALSE(std::signbit(wrap_to_two_pi(-0.0)));
  EXPECT_FALSE(std::signbit(wrap_to_two_pi(-kTwoPi)));
}

TEST(WrapToTwoPi, StandsTheLargestNumbers) {
  for (const double angle : {kHuge, -kHuge}) {
    EXPECT_GE(wrap_to_two_pi(angle), 0.0);
    EXPECT_LT(wrap_to_two_pi(angle), kTwoPi);
    EXPECT_GE(wrap_to_pi(angle), -kPi);
    EXPECT_LT(wrap_to_pi(angle), kPi);
  }
}

RC_GTEST_PROP(WrapToTwoPi, StaysInBounds, ()) {
  const double wrapped = wrap_to_two_pi(any_angle());
  RC_ASSERT(wrapped >= 0.0);
  RC_ASSERT(wrapped < kTwoPi);
}

RC_GTEST_PROP(WrapToTwoPi, KeepsSineAndCosine, ()) {
  const double angle = 1e-3 * (*rc::gen::inRange(-10'000'000, 10'000'001));
  RC_ASSERT(std::abs(std::sin(wrap_to_two_pi(angle)) - std::sin(angle)) < 1e-11);
  RC_ASSERT(std::abs(std::cos(wrap_to_two_pi(angle)) - std::cos(angle)) < 1e-11);
}

TEST(WrapToPi, EndsAreMinusPiAndBelowPi) {
  EXPECT_EQ(wrap_to_pi(kPi), -kPi);
  EXPECT_EQ(wrap_to_pi(-kPi), -kPi);
  EXPECT_NEAR(wrap_to_pi(kPi - 1e-9), kPi - 1e-9, 1e-14);
  EXPECT_NEAR(wrap_to_pi(kPi + 1e-9), -kPi + 1e-9, 1e-14);
  EXPECT_LT(wrap_to_pi(std::nextafter(-kPi, -4.0)), kPi);
}

RC_GTEST_PROP(WrapToPi, StaysInBounds, ()) {
  const double wrapped = wrap_to_pi(any_angle());
  RC_ASSERT(wrapped >= -kPi);
  RC_ASSERT(wrapped < kPi);
}

}  // namespace
}  // namespace tagfield
