// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/least_squares.h"

#include <algorithm>
#include <set>

#include "tagfield/localization/holograms/hologram.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/phase_curves/phase_following.h"
#include "tagfield/localization/phase_curves/place_search.h"
#include "tagfield/localization/phase_noise.h"

namespace tagfield {
namespace {

/// Hyperbolae to start from: fewer than the paper's method needs, as the fit does the rest.
constexpr double kStride = 0.5;  // [m]
constexpr std::size_t kMaxHyperbolae = 20;
/// Distance from the antennas' plane to the one in which a tag of unknown height is searched [m].
constexpr double kLikelyOffset = 0.4;

double search_height(const LocalizationProblem& problem, const std::string& tag) {
  const auto side = side_to_estimate(problem, tag);
  if (!side) return plane_height(problem, tag);
  return plane_height(problem, tag) +
         (*side == HeightSide::kAbove ? kLikelyOffset : -kLikelyOffset);
}

std::vector<std::string> antennas_of(const TagPhases& phases) {
  std::set<std::string> names;
  for (const TagPhases::Span& span : phases.spans) names.insert(span.antenna);
  return {names.begin(), names.end()};
}

/// Fallback if no hyperbolae intersect, as for short straight sections: the brightest positions,
/// treating unwrapped phases as wrapped.
std::vector<Eigen::Vector2d> by_waves(const PositionSearch& search, double height) {
  std::vector<Eigen::Vector2d> places =
      search_plane(search.phases, height, SearchOptions{}, coherent_light());
  for (Eigen::Vector2d& place : places) place = refine(search.phases, height, place);
  return places;
}

TagEstimate locate(const LocalizationProblem& problem, const std::string& tag,
                   const SamplesOfTag& samples) {
  TagEstimate estimate = begun(tag, samples);
  UnwrappedFit fit = fit_unwrapped(problem, tag, samples);
  if (!fit.why_not.empty()) return not_located(std::move(estimate), fit.why_not);
  const std::string noisy = why_too_noisy(samples, kSlipsWithoutOne);
  if (!noisy.empty()) return not_located(std::move(estimate), noisy);
  estimate.reads = static_cast<std::size_t>(fit.phases.size());
  estimate.candidates = make_candidates(fit.phases, fit.height, std::move(fit.fits));
  judge(problem.limits, estimate);
  return estimate;
}

}  // namespace

UnwrappedFit fit_unwrapped(const LocalizationProblem& problem, const std::string& tag,
                           const SamplesOfTag& samples) {
  UnwrappedFit result;
  result.why_not = why_not_locatable(samples);
  if (!result.why_not.empty()) return result;
  const double height = search_height(problem, tag);
  PositionSearch search = begin_search(samples, height, [](const std::vector<PhaseSample>& of) {
    return follow(of, phase_noise(of));
  });
  result.reads_followed = static_cast<std::size_t>(search.phases.size());
  result.segments = search.segments.size();
  result.why_not = why_too_few(search);
  if (!result.why_not.empty()) return result;
  search_positions(search, kStride, kMaxHyperbolae);
  if (search.minima.empty()) search.minima = by_waves(search, height);
  if (search.minima.empty()) {
    result.why_not = "no position explains the phase";
    return result;
  }
  result.phases = std::move(search.phases);
  result.phases.pose_error = stated_pose_error(problem);
  result.height = height_model(problem, tag, result.phases);
  for (const Eigen::Vector2d& place : search.minima) {
    const PositionVector start = to_unknowns(result.height, {place.x(), place.y(), height});
    result.fits.push_back(fit_tag(result.phases, result.height, start));
  }
  std::stable_sort(result.fits.begin(), result.fits.end(),
                   [](const TagFit& a, const TagFit& b) { return a.cost < b.cost; });
  result.antennas = antennas_of(result.phases);
  return result;
}

Method least_squares_method() {
  return ignoring(
      {"offset"},
      one_by_one("least_squares", "least squares on unwrapped phase, an offset for each section",
                 locate));
}

}  // namespace tagfield
