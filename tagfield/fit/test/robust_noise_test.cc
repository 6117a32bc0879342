// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/robust_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tagfield {
namespace {

// The median magnitude of normal values is 0.67449 sigma.
TEST(RobustNoise, IsTheMedianMagnitudeOfNormalOnes) {
  const std::vector<double> residuals = {-0.67449, 0.1, 0.67449, 5.0, -0.67449};
  EXPECT_NEAR(robust_noise(residuals, 0, 0.01), 1.0, 1e-4);
}

TEST(RobustNoise, UnknownsThatWereFittedMakeItGreater) {
  const std::vector<double> residuals(8, 0.67449);
  EXPECT_NEAR(robust_noise(residuals, 6, 0.01), 2.0, 1e-4);
  EXPECT_NEAR(robust_noise(residuals, 100, 0.01), std::sqrt(8.0), 1e-4);
}

TEST(RobustNoise, IsNotBelowTheLeast) { EXPECT_EQ(robust_noise({0.0, 0.0}, 0, 0.02), 0.02); }

}  // namespace
}  // namespace tagfield
