// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/color_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/report/summary.h"

namespace tagfield {
namespace {

/// viridis (S. van der Walt and N. Smith, 2015), in steps of a tenth, from its second tenth on; the
/// colours before are too dark on near-black.
constexpr std::array<Rgb, 9> kStops = {
    Rgb{0.255, 0.267, 0.529}, Rgb{0.208, 0.373, 0.553}, Rgb{0.165, 0.471, 0.557},
    Rgb{0.129, 0.569, 0.549}, Rgb{0.133, 0.659, 0.518}, Rgb{0.267, 0.749, 0.439},
    Rgb{0.478, 0.820, 0.318}, Rgb{0.741, 0.875, 0.149}, Rgb{0.992, 0.906, 0.145}};
constexpr double kMinOpacity = 0.7;

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
  return kMinOpacity + (1.0 - kMinOpacity) * clamped(strength);
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
