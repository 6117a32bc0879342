// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/unwrap.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/localization/phase_noise.h"

namespace tagfield {
namespace {

/// Margin kept below π, in standard deviations √2 σ of a phase difference. The fit corrects the
/// rare remaining slips (plane_fit.h).
constexpr double kNoiseMargin = 2.5;
/// Fraction of a quarter wavelength over which phases are always unwrapped, however noisy.
constexpr double kMinStep = 0.5;

double travel_between(const PhaseSample& from, const PhaseSample& to) {
  return (to.p_WA - from.p_WA).norm();
}

}  // namespace

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
                         travel_between(samples[i - 1], sample) <= limit * lambda / 4.0;
    if (!follows) segments.emplace_back();
    PhaseSegment& segment = segments.back();
    const double turn = follows ? wrap_to_pi(sample.phase_rad - samples[i - 1].phase_rad) : 0.0;
    const double before = follows ? segment.distance_m.back() : 0.0;
    segment.distance_m.push_back(before + lambda / (4.0 * kPi) * turn);
    segment.samples.push_back(sample);
  }
  return segments;
}

TagPhases unwrapped_phases(const std::vector<PhaseSegment>& segments,
                           const std::vector<std::string>& antennas) {
  TagPhases phases;
  phases.unwrapped = true;
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const auto count = static_cast<Eigen::Index>(segments[s].samples.size());
    const double cycle_m = cycle_of(segments[s].samples.front().frequency_hz);
    phases.spans.push_back({at, count, antennas[s], false, cycle_m});
    at += count;
  }
  resize(phases, at);
  at = 0;
  for (const PhaseSegment& segment : segments) {
    for (std::size_t i = 0; i < segment.samples.size(); ++i, ++at) {
      put(phases, at, segment.samples[i]);
      phases.value[at] = segment.distance_m[i];
    }
  }
  return phases;
}

}  // namespace tagfield
