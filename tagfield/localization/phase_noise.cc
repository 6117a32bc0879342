// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_noise.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/median.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Whether the two steps between three samples on one carrier are nearly equal in length and
/// together shorter than λ/2.
bool is_even_triple(const PhaseSample& a, const PhaseSample& b, const PhaseSample& c) {
  const double first = (b.p_WA - a.p_WA).norm();
  const double second = (c.p_WA - b.p_WA).norm();
  const bool same_carrier = a.frequency_hz == b.frequency_hz && b.frequency_hz == c.frequency_hz;
  return same_carrier && std::abs(first - second) < 0.02 * wavelength(b.frequency_hz) &&
         first + second < 0.5 * wavelength(b.frequency_hz);
}

}  // namespace

double phase_noise(const std::vector<PhaseSample>& samples) {
  constexpr std::size_t kFewest = 8;
  std::vector<double> bends;
  for (std::size_t i = 2; i < samples.size(); ++i) {
    if (!is_even_triple(samples[i - 2], samples[i - 1], samples[i])) continue;
    bends.push_back(wrap_to_pi(samples[i].phase_rad - 2.0 * samples[i - 1].phase_rad +
                               samples[i - 2].phase_rad));
  }
  if (bends.size() < kFewest) return 0.0;
  // A second difference has variance 6 σ².
  return sigma_by_median(std::move(bends)) / std::sqrt(6.0);
}

double largest_phase_noise(const SamplesOfTag& samples, double least) {
  double noise = least;
  for (const auto& [antenna, series] : samples) noise = std::max(noise, phase_noise(series));
  return noise;
}

double expected_slips(const SamplesOfTag& samples) {
  double slips = 0.0;
  for (const auto& [antenna, series] : samples) {
    const double sigma = phase_noise(series);
    if (sigma > 0.0) slips += static_cast<double>(series.size()) * std::erfc(kPi / (2.0 * sigma));
  }
  return slips;
}

}  // namespace tagfield
