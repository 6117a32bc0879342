// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/outlying.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "tagfield/base/median.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Mean phases of the channels, over the reads that are kept.
std::vector<double> middles_of(const std::vector<PhaseLeft>& left, const std::vector<bool>& out) {
  std::vector<std::complex<double>> sums;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i].channel >= sums.size()) sums.resize(left[i].channel + 1);
    if (!out[i]) sums[left[i].channel] += std::polar(1.0, left[i].rad);
  }
  std::vector<double> middles(sums.size());
  std::transform(sums.begin(), sums.end(), middles.begin(),
                 [](const std::complex<double>& sum) { return std::arg(sum); });
  return middles;
}

}  // namespace

PhaseSpread spread_of(const std::vector<PhaseLeft>& left, double noise_rad) {
  constexpr int kRounds = 3;
  constexpr double kFar = 4.0;          // Standard deviations.
  constexpr double kOfMedian = 1.4826;  // σ of a normal distribution per median of |x|.
  constexpr double kMost = 1.0 / 7.0;   // Of the reads.
  PhaseSpread spread{std::vector<double>(left.size()), std::vector<bool>(left.size(), false)};
  auto& [off, out] = spread;
  if (left.empty()) return spread;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<double> middles = middles_of(left, out);
    std::transform(left.begin(), left.end(), off.begin(), [&](const PhaseLeft& read) {
      return std::abs(wrap_to_pi(read.rad - middles[read.channel]));
    });
    const double far = kFar * std::max(noise_rad, kOfMedian * median(off));
    std::transform(off.begin(), off.end(), out.begin(), [&](double one) { return one > far; });
  }
  const auto count = static_cast<double>(std::count(out.begin(), out.end(), true));
  if (count > kMost * static_cast<double>(left.size())) out.assign(left.size(), false);
  return spread;
}

}  // namespace tagfield
