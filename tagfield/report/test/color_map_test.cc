// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/color_map.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace tagfield {
namespace {

std::size_t strongest_part(const Rgb& color) {
  return static_cast<std::size_t>(std::max_element(color.begin(), color.end()) - color.begin());
}

TEST(StrengthColor, IsBlueGreenRedFromLowToHigh) {
  EXPECT_EQ(strongest_part(strength_color(0.0)), 2U);
  EXPECT_EQ(strongest_part(strength_color(0.5)), 1U);
  EXPECT_EQ(strongest_part(strength_color(1.0)), 0U);
}

TEST(StrengthColor, HoldsItsEnds) {
  EXPECT_EQ(strength_color(-3.0), strength_color(0.0));
  EXPECT_EQ(strength_color(7.0), strength_color(1.0));
}

TEST(StrengthOpacity, RisesToFull) {
  double last = 0.0;
  for (int i = 0; i <= 10; ++i) {
    EXPECT_GT(strength_opacity(0.1 * i), last);
    last = strength_opacity(0.1 * i);
  }
  EXPECT_DOUBLE_EQ(last, 1.0);
}

TEST(HexColor, IsCss) { EXPECT_EQ(hex_color({1.0, 0.5, 0.0}), "#ff8000"); }

TEST(StrengthOf, IsBetweenLowAndHigh) {
  EXPECT_DOUBLE_EQ(strength_of(-60.0, -80.0, -40.0), 0.5);
  EXPECT_DOUBLE_EQ(strength_of(-90.0, -80.0, -40.0), 0.0);
  EXPECT_DOUBLE_EQ(strength_of(-60.0, -60.0, -60.0), 0.5);
}

}  // namespace
}  // namespace tagfield
