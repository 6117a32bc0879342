// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

/// Round step that divides `range` > 0 into about `count` parts.
double round_step(double range, int count) {
  const double rough = range / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  if (lead < 1.5) return power;
  if (lead < 3.5) return 2.0 * power;
  return (lead < 7.5 ? 5.0 : 10.0) * power;
}

/// Width of a range, greater than 0 even if it is a point.
double width_of(double low, double high) {
  return std::max(high - low, 1e-9 * std::max({std::abs(low), std::abs(high), 1.0}));
}

std::vector<double> multiples(double step, double first, double last) {
  std::vector<double> ticks;
  const auto steps = static_cast<int>(std::lround(last - first));
  for (int i = 0; i <= steps; ++i) ticks.push_back((first + i) * step);
  return ticks;
}

std::string label_of(double tick, int decimals) {
  const std::string digits = fmt::format("{:.{}f}", std::abs(tick), decimals);
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return fmt::format("{}{}", tick < 0.0 && !zero ? "−" : "", digits);
}

}  // namespace

std::vector<double> covering_ticks(double low, double high, int count) {
  const double step = round_step(width_of(low, high), count);
  const double first = std::floor(low / step + 1e-9);
  const double last = std::max(std::ceil(high / step - 1e-9), first + 1.0);
  return multiples(step, first, last);
}

std::vector<double> inner_ticks(double low, double high, int count) {
  const double step = round_step(width_of(low, high), count);
  return multiples(step, std::ceil(low / step - 1e-9), std::floor(high / step + 1e-9));
}

std::vector<double> logarithmic_ticks(double low, double high) {
  const bool wide = high / low > 1e3;
  std::vector<double> ticks;
  const auto first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
  const auto last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  for (int exponent = first; exponent <= last; ++exponent) {
    const double power = std::pow(10.0, exponent);
    for (const double lead : {1.0, 2.0, 5.0}) {
      const double tick = lead * power;
      const bool wanted = lead == 1.0 || !wide;
      if (wanted && tick >= low * (1.0 - 1e-9) && tick <= high * (1.0 + 1e-9)) {
        ticks.push_back(tick);
      }
    }
  }
  return ticks;
}

std::vector<std::string> tick_labels(const std::vector<double>& ticks) {
  double least = 1.0;
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    least = std::min(least, std::abs(ticks[i] - ticks[i - 1]));
  }
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(least) - 1e-9)), 0, 9);
  std::vector<std::string> labels;
  labels.reserve(ticks.size());
  for (const double tick : ticks) labels.push_back(label_of(tick, decimals));
  return labels;
}

std::vector<std::string> logarithmic_labels(const std::vector<double>& ticks) {
  std::vector<std::string> labels;
  for (const double tick : ticks) {
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(tick) - 1e-9)), 0, 9);
    labels.push_back(fmt::format("{:.{}f}", tick, decimals));
  }
  return labels;
}

}  // namespace tagfield
