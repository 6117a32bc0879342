// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/median.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tagfield {
namespace {

TEST(Median, IsTheMiddleOfTheSorted) {
  EXPECT_EQ(median({}), 0.0);
  EXPECT_EQ(median({3.0}), 3.0);
  EXPECT_EQ(median({9.0, -1.0, 4.0}), 4.0);
  EXPECT_EQ(median({9.0, -1.0, 4.0, 5.0}), 5.0);
}

TEST(SigmaByMedian, OfNormalQuantilesIsTheirSigma) {
  // The 75 % quantile of a standard normal variable is 0.67449.
  EXPECT_EQ(sigma_by_median({}), 0.0);
  EXPECT_NEAR(sigma_by_median({-0.67449 * 3.0, 0.1, 9.0}), 3.0, 1e-3);
}

TEST(SigmaByMedian, OneInTenFarOffMovesItLittle) {
  std::vector<double> values;
  // Midpoints of equal shares of a logistic distribution, whose 75 % quantile is ln 3.
  for (int i = 0; i < 9000; ++i) {
    const double share = (i + 0.5) / 9000.0;
    values.push_back(std::log(share / (1.0 - share)) / std::log(3.0) * 0.67449);
  }
  EXPECT_NEAR(sigma_by_median(values), 1.0, 1e-3);
  values.resize(10000, 1e9);
  EXPECT_GT(sigma_by_median(values), 1.0);
  EXPECT_LT(sigma_by_median(values), 1.25);
}

}  // namespace
}  // namespace tagfield
