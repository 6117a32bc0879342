// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/pi_ambiguity.h"

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr int kFewest = 100;
constexpr double kClearly = 0.1;
/// For random phases, a sum of n such differences deviates by about √n.
constexpr double kChance = 2.5;
/// Share of a wavelength that changes the phase by π/4.
constexpr double kShortStep = 1.0 / 16.0;

struct Means {
  double once = 0.0;   ///< Σ cos Δφ.
  double twice = 0.0;  ///< Σ cos 2Δφ.
  int count = 0;
};

void look_at(const std::vector<PhaseSample>& series, Means& means) {
  for (std::size_t i = 1; i < series.size(); ++i) {
    const PhaseSample& a = series[i - 1];
    const PhaseSample& b = series[i];
    const double travel = (b.p_WA - a.p_WA).norm();
    if (a.frequency_hz != b.frequency_hz || travel > kShortStep * wavelength(b.frequency_hz)) {
      continue;
    }
    means.once += std::cos(b.phase_rad - a.phase_rad);
    means.twice += std::cos(2.0 * (b.phase_rad - a.phase_rad));
    ++means.count;
  }
}

}  // namespace

bool has_pi_ambiguity(const SamplesByTag& samples) {
  Means means;
  for (const auto& [tag, of_tag] : samples) {
    for (const auto& [antenna, series] : of_tag) look_at(series, means);
  }
  const double least = kClearly * means.count + kChance * std::sqrt(means.count);
  return means.count >= kFewest && means.twice - means.once > least;
}

void double_phases(SamplesByTag& samples) {
  for (auto& [tag, of_tag] : samples) {
    for (auto& [antenna, series] : of_tag) {
      for (PhaseSample& sample : series) {
        sample.phase_rad = wrap_to_two_pi(2.0 * sample.phase_rad);
        sample.frequency_hz *= 2.0;
      }
    }
  }
}

}  // namespace tagfield
