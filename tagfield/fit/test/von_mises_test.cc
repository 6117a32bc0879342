// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/von_mises.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tagfield {
namespace {

TEST(VonMises, ConcentrationInvertsTheRatioOfBesselFunctions) {
  for (double kappa = 0.02; kappa < 200.0; kappa *= 1.05) {
    const double mean_cosine = std::cyl_bessel_i(1.0, kappa) / std::cyl_bessel_i(0.0, kappa);
    EXPECT_NEAR(von_mises_concentration(mean_cosine), kappa, 0.01 * kappa);
  }
  EXPECT_EQ(von_mises_concentration(0.0), 0.0);
}

}  // namespace
}  // namespace tagfield
