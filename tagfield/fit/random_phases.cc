// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/random_phases.h"

#include <algorithm>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kNowhere = 0.05;  ///< Share of outliers.

/// 2π times the wrapped normal density; ±3 periods are more than enough up to kMaxPhaseNoise_rad.
double wrapped_normal(double residual, double noise) {
  double sum = 0.0;
  for (int turn = -3; turn <= 3; ++turn) {
    const double z = (residual + kTwoPi * turn) / noise;
    sum += std::exp(-0.5 * z * z);
  }
  return std::sqrt(kTwoPi) / noise * sum;
}

}  // namespace

double evidence_of_residuals(const std::vector<double>& residuals, double noise_rad,
                             double min_noise_rad) {
  if (residuals.empty()) return 0.0;
  const double noise = std::clamp(noise_rad, min_noise_rad, kMaxPhaseNoise_rad);
  const auto count = static_cast<double>(residuals.size());
  // The relative uncertainty of the noise is about 1/√(2n).
  double evidence = std::min(
      0.0, 0.5 * std::log(kPi / count) - std::log(std::log(kMaxPhaseNoise_rad / min_noise_rad)));
  for (const double residual : residuals) {
    evidence += std::log((1.0 - kNowhere) * wrapped_normal(residual, noise) + kNowhere);
  }
  return evidence;
}

double evidence_of_offset(std::size_t count, double noise_rad) {
  const double sigma = noise_rad / std::sqrt(static_cast<double>(std::max<std::size_t>(count, 1)));
  return std::min(0.0, std::log(sigma / std::sqrt(kTwoPi)));
}

}  // namespace tagfield
