// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/color_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/report/summary.h"

namespace tagfield {
namespace {

/// Blue, teal, green, amber, red, evenly apart: each readable on white and on near-black.
constexpr std::array<Rgb, 5> kStops = {Rgb{0.20, 0.38, 0.90}, Rgb{0.05, 0.60, 0.70},
                                       Rgb{0.13, 0.65, 0.28}, Rgb{0.90, 0.60, 0.05},
                                       Rgb{0.86, 0.15, 0.15}};
constexpr double kLeastOpacity = 0.4;

double clamped(double strength) { return std::clamp(strength, 0.0, 1.0); }

int byte_of(double part) { return static_cast<int>(std::lround(clamped(part) * 255.0)); }

}  // namespace

Rgb strength_color(double strength) {
  const double place = clamped(strength) * (kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const double fraction = place - static_cast<double>(below);
  Rgb color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = (1.0 - fraction) * kStops[below][i] + fraction * kStops[below + 1][i];
  }
  return color;
}

double strength_opacity(double strength) {
  return kLeastOpacity + (1.0 - kLeastOpacity) * clamped(strength);
}

std::string hex_color(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", byte_of(color[0]), byte_of(color[1]),
                     byte_of(color[2]));
}

std::pair<double, double> color_range(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.05), quantile(values, 0.95)};
}

double strength_of(double value, double low, double high) {
  return high > low ? clamped((value - low) / (high - low)) : 0.5;
}

}  // namespace tagfield
