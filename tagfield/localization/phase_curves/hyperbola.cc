// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/hyperbola.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/phase_curves/place_search.h"
#include "tagfield/localization/phase_curves/unwrap.h"
#include "tagfield/localization/residuals.h"

namespace tagfield {
namespace {

/// Keys of the options.
const OptionTable<HyperbolaOptions>& hyperbola_options() {
  using O = HyperbolaOptions;
  static const OptionTable<O> of{
      {setting<O>("stride_m", "m", "travel of the antenna between two hyperbolae", &O::stride_m,
                  kOverZero),
       setting<O>("max_hyperbolae", "", "of one tag; more are thinned out (time grows as n³)",
                  &O::max_hyperbolae, {2.0}),
       setting<O>("max_step", "λ/4", "longest travel between reads over which phases are followed",
                  &O::max_step, {0.0, true, 1.0}),
       setting<O>("refine", "finish by least squares from the best intersections", &O::refine)}};
  return of;
}

/// Minima that cannot be distinguished from the first.
std::vector<Eigen::Vector2d> indistinct(const PositionSearch& search) {
  const std::vector<Eigen::Vector2d>& minima = search.minima;
  const auto residuals_at = [&](const Eigen::Vector2d& p) {
    return residuals(search.phases, search.height, p);
  };
  const Eigen::ArrayXd best = residuals_at(minima.front());
  std::vector<Eigen::Vector2d> kept{minima.front()};
  for (std::size_t i = 1; i < minima.size(); ++i) {
    if (!tells_apart(search.phases.spans, best, residuals_at(minima[i]))) kept.push_back(minima[i]);
  }
  return kept;
}

/// The best intersection around each minimum, for the method without its last step.
std::vector<Eigen::Vector2d> unrefined(const PositionSearch& search,
                                       const std::vector<Eigen::Vector2d>& minima) {
  std::vector<Eigen::Vector2d> places;
  const std::vector<Guess> guesses =
      rank(search.phases, search.height, best_distinct(search.ranked, 60, 0.0));
  for (const Eigen::Vector2d& minimum : minima) {
    const auto nearest = [&](const Guess& guess) {
      return std::none_of(minima.begin(), minima.end(), [&](const Eigen::Vector2d& other) {
        return (guess.p - other).norm() < (guess.p - minimum).norm();
      });
    };
    const auto found = std::find_if(guesses.begin(), guesses.end(), nearest);
    places.push_back(found == guesses.end() ? minimum : found->p);
  }
  return places;
}

/// Without fitted_away(): each of many short sections has its own offset, which takes up slow
/// errors before the position does.
Candidate candidate_of(const TagPhases& phases, const HeightModel& height, const TagFit& fit) {
  if (phases.pose_error) return make_candidate(phases, height, fit);
  const double rms_m = std::sqrt(residuals_of(phases, height, fit).square().mean());
  return make_candidate(height, fit.unknowns, covariance_of(phases, height, fit), rms_m);
}

Candidate candidate_at(const TagPhases& phases, const Eigen::Vector2d& p, double height) {
  const HeightModel known{HeightModel::Kind::kKnown, height, 1.0};
  TagFit fit;
  fit.unknowns = {p.x(), p.y(), 0.0};
  fit.offsets = offsets_at(phases, known, fit.unknowns);
  return candidate_of(phases, known, fit);
}

/// Accounts for a guessed plane: the position may be off by as much as it moves if the height is
/// estimated, plus the uncertainty of that estimate.
void span_height(const TagPhases& phases, HeightSide side, Candidate& candidate) {
  const HeightModel height = estimated_height(side, phases);
  const TagFit fit = fit_tag(phases, height, to_unknowns(height, candidate.p_WT));
  const Candidate free = candidate_of(phases, height, fit);
  if (!free.covariance) return;
  const Eigen::Vector3d off = free.p_WT - candidate.p_WT;
  candidate.covariance = *free.covariance + off * off.transpose();
  candidate.expected_error_m = std::sqrt(candidate.covariance->topLeftCorner<2, 2>().trace());
}

}  // namespace

TagEstimate locate_by_hyperbolae(const std::string& tag, const SamplesOfTag& samples,
                                 double tag_height, const HyperbolaOptions& options,
                                 const EstimateLimits& limits,
                                 const std::optional<PoseErrorModel>& pose_error,
                                 const std::optional<HeightSide>& side) {
  check_options(hyperbola_options(), options);
  if (!std::isfinite(tag_height)) throw Error("the tag's height must be finite");
  TagEstimate estimate = begun(tag, samples);
  const std::string hopeless = why_not_locatable(samples);
  if (!hopeless.empty()) return not_located(std::move(estimate), hopeless);
  const std::string noisy = why_too_noisy(samples, kSlipsWithoutOne);
  if (!noisy.empty()) return not_located(std::move(estimate), noisy);
  PositionSearch search = begin_search(
      samples, tag_height,
      [&](const std::vector<PhaseSample>& of) { return unwrap(of, options.max_step); });
  estimate.reads = static_cast<std::size_t>(search.phases.size());
  const std::string too_few = why_too_few(search);
  if (!too_few.empty()) return not_located(std::move(estimate), too_few);
  search_positions(search, options.stride_m, options.max_hyperbolae);
  if (search.minima.empty()) return not_located(std::move(estimate), "no two hyperbolae meet");
  std::vector<Eigen::Vector2d> places = indistinct(search);
  if (!options.refine) places = unrefined(search, places);
  if (pose_error && pose_error->sigma_m > 0.0) search.phases.pose_error = pose_error;
  for (const Eigen::Vector2d& p : places) {
    estimate.candidates.push_back(candidate_at(search.phases, p, tag_height));
    if (side) span_height(search.phases, *side, estimate.candidates.back());
  }
  judge(limits, estimate);
  return estimate;
}

Method hyperbola_method(const HyperbolaOptions& options) {
  return ignoring(
      {"offset"},
      one_by_one("hyperbola", "hyperbolae from unwrapped phase, their intersections (the paper's)",
                 hyperbola_options(), options,
                 [](const LocalizationProblem& problem, const std::string& tag,
                    const SamplesOfTag& samples, const HyperbolaOptions& of) {
                   return locate_by_hyperbolae(tag, samples, plane_height(problem, tag), of,
                                               problem.limits, problem.pose_error,
                                               side_to_estimate(problem, tag));
                 }));
}

}  // namespace tagfield
