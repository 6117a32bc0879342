// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/units.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

namespace tagfield {
namespace {

TEST(Decibels, AgreeWithKnownRatios) {
  EXPECT_DOUBLE_EQ(to_db(1000.0), 30.0);
  EXPECT_NEAR(to_db(2.0), 3.0103, 1e-5);
  EXPECT_DOUBLE_EQ(from_db(-20.0), 0.01);
  EXPECT_DOUBLE_EQ(amplitude_to_db(10.0), 20.0);
  EXPECT_DOUBLE_EQ(amplitude_from_db(-40.0), 0.01);
}

TEST(Decibels, OfNothingAreFinite) {
  EXPECT_EQ(to_db(0.0), kNothing_db);
  EXPECT_EQ(to_db(1e-100), kNothing_db);
  EXPECT_EQ(to_db(std::numeric_limits<double>::quiet_NaN()), kNothing_db);
}

RC_GTEST_PROP(Decibels, GoThereAndBack, ()) {
  const double db = 0.01 * (*rc::gen::inRange(-30'000, 30'001));
  RC_ASSERT(std::abs(to_db(from_db(db)) - db) < 1e-9);
  RC_ASSERT(std::abs(amplitude_to_db(amplitude_from_db(db)) - db) < 1e-9);
  // The square of an amplitude is a power.
  const double amplitude = amplitude_from_db(db);
  RC_ASSERT(std::abs(amplitude * amplitude / from_db(db) - 1.0) < 1e-12);
}

TEST(Radians, AgreeWithKnownAngles) {
  EXPECT_DOUBLE_EQ(radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(radians(-45.0), -kPi / 4.0);
}

TEST(Wavelength, IsThatOfTheBandTables) {
  EXPECT_NEAR(wavelength(865.7e6), 0.34630, 5e-6);
  EXPECT_NEAR(wavelength(915e6), 0.32764, 5e-6);
}

TEST(Degrees, AgreeWithKnownAngles) {
  EXPECT_DOUBLE_EQ(degrees(kPi), 180.0);
  EXPECT_DOUBLE_EQ(degrees(-kPi / 4.0), -45.0);
}

// A half-wave dipole's directivity is 2 / ∫ cos²(π/2·cos θ)/sin θ dθ, by Simpson's rule.
TEST(Dipole, HasTheGainOfItsPattern) {
  constexpr int kSteps = 1000;
  double sum = 0.0;
  for (int i = 1; i < kSteps; ++i) {
    const double angle = kPi * i / kSteps;
    const double amplitude = std::cos(0.5 * kPi * std::cos(angle));
    sum += (i % 2 == 0 ? 2.0 : 4.0) * amplitude * amplitude / std::sin(angle);
  }
  EXPECT_NEAR(to_db(2.0 / (sum * kPi / kSteps / 3.0)), kDipole_dbi, 0.005);
}

}  // namespace
}  // namespace tagfield
