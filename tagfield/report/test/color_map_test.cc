// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/color_map.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/files/files.h"
#include "tagfield/report/internal/color_bands.h"

namespace tagfield {
namespace {

/// CIE 1976 lightness L* of an sRGB colour, in [0, 100] (CIE 15:2004; IEC 61966-2-1).
double lightness(const Rgb& color) {
  const std::array<double, 3> shares = {0.2126, 0.7152, 0.0722};
  double luminance = 0.0;
  for (std::size_t i = 0; i < color.size(); ++i) {
    const double part = color[i];
    luminance +=
        shares[i] * (part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
  }
  return luminance <= 0.008856 ? 903.3 * luminance : 116.0 * std::cbrt(luminance) - 16.0;
}

TEST(StrengthColor, GetsLighterInEvenSteps) {
  constexpr int kSteps = 16;
  const double step = (lightness(strength_color(1.0)) - lightness(strength_color(0.0))) / kSteps;
  EXPECT_GT(step * kSteps, 55.0);
  for (int i = 0; i < kSteps; ++i) {
    const double from = lightness(strength_color(i / double{kSteps}));
    const double to = lightness(strength_color((i + 1) / double{kSteps}));
    EXPECT_NEAR(to - from, step, 0.15 * step) << i;
  }
}

/// The live page has a table of its own, as it draws in the browser.
TEST(StrengthColor, IsThatOfTheLivePage) {
  const std::string script =
      read_text_file(TAGFIELD_SOURCE_DIR "/adapters/http/page/src/colors.js");
  const std::regex triple(R"(\[(\d+), (\d+), (\d+)\])");
  const std::vector<std::smatch> colors(std::sregex_iterator(script.begin(), script.end(), triple),
                                        std::sregex_iterator());
  ASSERT_EQ(colors.size(), 9U);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const Rgb color = strength_color(static_cast<double>(i) / 8.0);
    for (std::size_t k = 0; k < color.size(); ++k) {
      EXPECT_NEAR(255.0 * color[k], std::stoi(colors[i].str(k + 1)), 0.5) << i;
    }
  }
}

Rgb parsed(const std::string& hex) {
  Rgb color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = std::stoi(hex.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
  }
  return color;
}

TEST(ColorBands, OfEachQuantityGetLighterBandByBand) {
  const std::pair<const char*, ColorBands> all[] = {
      {"power", power_bands("power [dBm]", {-63.0, -20.0, 12.0})},
      {"margin", margin_bands()},
      {"probability", probability_bands()},
      {"agreement", agreement_bands(0.9)}};
  for (const auto& [quantity, bands] : all) {
    double last = 0.0;
    for (const std::string& color : bands.colors) {
      if (color.empty()) continue;  // Not drawn.
      EXPECT_GT(lightness(parsed(color)), last + 3.0) << quantity << " " << color;
      last = lightness(parsed(color));
    }
    EXPECT_GT(last, 80.0) << quantity;
  }
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
