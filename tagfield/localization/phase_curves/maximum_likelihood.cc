// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/maximum_likelihood.h"

#include <algorithm>

#include "tagfield/localization/judgement.h"
#include "tagfield/localization/phase_curves/least_squares.h"
#include "tagfield/localization/phase_curves/place_search.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxMinima = 4;  ///< Minima of the unwrapped fit used as starts.
/// Minima that cost this many times more than the best are not used.
constexpr double kHopeless = 30.0;

TagPhases without_known_offsets(TagPhases phases) {
  for (TagPhases::Span& span : phases.spans) span.offset_known = false;
  return phases;
}

/// Whether the antenna positions are too uncertain to resolve whole cycles between sections: a
/// standard deviation of over λ/24 turns the phase by half a radian, and four of those by a third
/// of a turn.
bool loses_cycles(const TagPhases& phases) {
  constexpr double kMost = 1.0 / 12.0;  // Of λ/2.
  return phases.pose_error && phases.pose_error->sigma_m > kMost * longest_cycle(phases);
}

/// The best fit from any of the starts around `fit`.
TagFit best_around(const TagPhases& phases, const HeightModel& height, const TagFit& fit,
                   const Eigen::Matrix3d& covariance) {
  TagFit best;
  bool is_first = true;
  for (const PositionVector& start : spread_starts(phases, height, fit, covariance)) {
    TagFit found = fit_tag(phases, height, start);
    if (is_first || found.cost < best.cost) best = std::move(found);
    is_first = false;
  }
  return best;
}

/// Fits of the wrapped phases near those of the unwrapped ones: first with free offsets, then with
/// the known ones, if any.
std::vector<TagFit> wrapped_fits(const UnwrappedFit& unwrapped, const TagPhases& phases) {
  const TagPhases free = without_known_offsets(phases);
  const bool any_known = std::any_of(phases.spans.begin(), phases.spans.end(),
                                     [](const auto& span) { return span.offset_known; });
  std::vector<TagFit> fits;
  for (const TagFit& from : unwrapped.fits) {
    if (fits.size() == kMaxMinima) break;
    if (from.cost > kHopeless * unwrapped.fits.front().cost + 1.0) break;
    const Eigen::Matrix3d covariance = covariance_of(unwrapped.phases, unwrapped.height, from);
    TagFit fit = best_around(free, unwrapped.height, from, covariance);
    if (any_known) {
      fit = best_around(phases, unwrapped.height, fit, covariance_of(free, unwrapped.height, fit));
    }
    fits.push_back(std::move(fit));
  }
  return fits;
}

}  // namespace

TagEstimate locate_by_likelihood(const LocalizationProblem& problem, const std::string& tag,
                                 const SamplesOfTag& samples) {
  TagEstimate estimate = begun(tag, samples);
  const UnwrappedFit unwrapped = fit_unwrapped(problem, tag, samples);
  if (!unwrapped.why_not.empty()) return not_located(std::move(estimate), unwrapped.why_not);
  const std::string noisy = why_too_noisy(samples, kSlipsWithOne);
  if (!noisy.empty()) return not_located(std::move(estimate), noisy);
  const TagPhases phases = wrapped_phases(problem, samples, unwrapped.antennas);
  if (loses_cycles(phases)) {
    estimate.reads = static_cast<std::size_t>(unwrapped.phases.size());
    estimate.candidates = make_candidates(unwrapped.phases, unwrapped.height, unwrapped.fits);
  } else {
    estimate.reads = static_cast<std::size_t>(phases.size());
    estimate.candidates =
        make_candidates(phases, unwrapped.height, wrapped_fits(unwrapped, phases));
  }
  judge(problem.limits, estimate);
  return estimate;
}

Method maximum_likelihood_method() {
  return one_by_one("ml",
                    "maximum likelihood on wrapped phase, an offset for each antenna and channel",
                    locate_by_likelihood);
}

}  // namespace tagfield
