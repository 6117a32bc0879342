#include "tagfield/localization/phase_curves/unwrap.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/median.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Noise of a phase difference is √2 σ; so many of it are kept free below π. Rare slips beyond
/// are put right by the fit (segment_fit.h).
constexpr double kNoiseMargin = 2.5;
/// However noisy, phases this part of a quarter wavelength apart are followed.
constexpr double kMinStep = 0.5;

double travel(const PhaseSample& from, const PhaseSample& to) {
  return (to.p_WA - from.p_WA).norm();
}

/// Phase that one step adds to the one before it, the two being nearly equal in length.
bool is_even_triple(const PhaseSample& a, const PhaseSample& b, const PhaseSample& c) {
  const double first = travel(a, b);
  const double second = travel(b, c);
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

double step_limit(double noise_rad, double max_step) {
  const double free_of_noise = 1.0 - kNoiseMargin * std::sqrt(2.0) * noise_rad / kPi;
  return std::min(max_step, std::max(kMinStep, free_of_noise));
}

std::vector<PhaseSegment> unwrap(const std::vector<PhaseSample>& samples, double max_step) {
  const double limit = step_limit(phase_noise(samples), max_step);
  std::vector<PhaseSegment> segments;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const PhaseSample& sample = samples[i];
    const double lambda = wavelength(sample.frequency_hz);
    const bool follows = i > 0 && samples[i - 1].frequency_hz == sample.frequency_hz &&
                         travel(samples[i - 1], sample) <= limit * lambda / 4.0;
    if (!follows) segments.emplace_back();
    PhaseSegment& segment = segments.back();
    const double turn = follows ? wrap_to_pi(sample.phase_rad - samples[i - 1].phase_rad) : 0.0;
    const double before = follows ? segment.distance_m.back() : 0.0;
    segment.distance_m.push_back(before + lambda / (4.0 * kPi) * turn);
    segment.samples.push_back(sample);
  }
  return segments;
}

}  // namespace tagfield
