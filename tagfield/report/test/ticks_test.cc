// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/ticks.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

using Ticks = std::vector<double>;
using Labels = std::vector<std::string>;

TEST(CoveringTicks, AreRoundNumbers) {
  EXPECT_EQ(covering_ticks(0.0, 39.0, 5), (Ticks{0, 10, 20, 30, 40}));
  EXPECT_EQ(covering_ticks(-3.0, 7.0, 5), (Ticks{-4, -2, 0, 2, 4, 6, 8}));
}

RC_GTEST_PROP(CoveringTicks, CoverAnyRange, ()) {
  const double low = *rc::gen::inRange(-100000, 100000) * 1e-3;
  const double high = low + *rc::gen::inRange(0, 1000000) * 1e-4;
  const int count = *rc::gen::inRange(2, 10);
  const Ticks ticks = covering_ticks(low, high, count);
  const double slack = 1e-6 * std::max(1.0, std::abs(low));
  RC_ASSERT(ticks.size() >= 2);
  RC_ASSERT(ticks.size() <= static_cast<std::size_t>(2 * count + 2));
  RC_ASSERT(ticks.front() <= low + slack);
  RC_ASSERT(ticks.back() >= high - slack);
  RC_ASSERT(std::is_sorted(ticks.begin(), ticks.end()));
}

TEST(InnerTicks, StayInside) { EXPECT_EQ(inner_ticks(-0.5, 4.2, 5), (Ticks{0, 1, 2, 3, 4})); }

TEST(LogarithmicTicks, AreOneTwoFive) {
  EXPECT_EQ(logarithmic_ticks(1.0, 20.0), (Ticks{1, 2, 5, 10, 20}));
}

TEST(LogarithmicTicks, ArePowersOverAWideRange) {
  EXPECT_EQ(logarithmic_ticks(1.0, 1e4), (Ticks{1, 10, 100, 1000, 10000}));
}

TEST(TickLabels, HaveTheDecimalsTheyNeed) {
  EXPECT_EQ(tick_labels({0.0, 0.5, 1.0}), (Labels{"0.0", "0.5", "1.0"}));
  EXPECT_EQ(tick_labels({-20.0, 0.0, 20.0}), (Labels{"−20", "0", "20"}));
}

TEST(LogarithmicLabels, HaveEachItsOwnDecimals) {
  EXPECT_EQ(logarithmic_labels({0.05, 0.5, 1.0, 20.0}), (Labels{"0.05", "0.5", "1", "20"}));
}

}  // namespace
}  // namespace tagfield
