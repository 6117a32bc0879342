// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/trigonometry.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/random.h"

namespace tagfield {
namespace {

constexpr int kDraws = 200'000;

/// The error of `value`, in units in the last place.
double units_off(double value, long double exact) {
  const auto nearest = static_cast<double>(exact);
  const double unit = std::nextafter(std::abs(nearest), HUGE_VAL) - std::abs(nearest);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact)) / unit;
}

double any_within(RandomStream& stream, double low, double high) {
  return low + (high - low) * uniform(stream);
}

TEST(ArcTangent, IsThatOfLongDoubleWithinThreeUnits) {
  RandomStream stream(3, Purpose::kReadNoise);
  double worst = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    // Of all magnitudes, and close to the axes, the diagonals and the table's entries.
    const double size = std::pow(10.0, any_within(stream, -100.0, 100.0));
    const double place = std::round(any_within(stream, -16.0, 16.0)) / 16.0;
    const double tiny = std::pow(10.0, any_within(stream, -17.0, 0.0));
    for (const double y : {any_within(stream, -1.0, 1.0), place, place + tiny, tiny, -tiny}) {
      for (const double x : {any_within(stream, -1.0, 1.0), 1.0, -1.0, y}) {
        const auto exact =
            std::atan2(static_cast<long double>(size * y), static_cast<long double>(size * x));
        worst = std::max(worst, units_off(arc_tangent(size * y, size * x), exact));
      }
    }
  }
  EXPECT_LT(worst, 3.0);
}

TEST(ArcTangent, HasTheStandardsSignsAtZeros) {
  for (const double y : {0.0, -0.0}) {
    for (const double x : {0.0, -0.0, 2.0, -2.0}) {
      EXPECT_EQ(arc_tangent(y, x), std::atan2(y, x));
      EXPECT_EQ(std::signbit(arc_tangent(y, x)), std::signbit(std::atan2(y, x)));
    }
  }
  EXPECT_EQ(arc_tangent(1.0, 0.0), 0.5 * kPi);
  EXPECT_EQ(arc_tangent(-1.0, -0.0), -0.5 * kPi);
}

TEST(ArcTangent, IsNotANumberOfWhatIsNotFinite) {
  for (const double odd : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_TRUE(std::isnan(arc_tangent(odd, 1.0)));
    EXPECT_TRUE(std::isnan(arc_tangent(1.0, odd)));
    EXPECT_TRUE(std::isnan(sine(odd)));
    EXPECT_TRUE(std::isnan(cosine(odd)));
  }
}

RC_GTEST_PROP(SineAndCosine, AreThoseOfLongDouble, ()) {
  const double x = 0.001 * *rc::gen::inRange(-1'000'000'000, 1'000'000'000);
  const double allowed = std::max(2.3e-16, 1e-16 * std::abs(x));
  RC_ASSERT(std::abs(sine(x) - static_cast<double>(std::sin(static_cast<long double>(x)))) <=
            allowed);
  RC_ASSERT(std::abs(cosine(x) - static_cast<double>(std::cos(static_cast<long double>(x)))) <=
            allowed);
}

RC_GTEST_PROP(ArcTangent, UndoesSineAndCosine, ()) {
  const double angle = 1e-6 * *rc::gen::inRange(-3'141'592, 3'141'593);
  RC_ASSERT(std::abs(arc_tangent(sine(angle), cosine(angle)) - angle) <= 1e-15);
}

}  // namespace
}  // namespace tagfield
