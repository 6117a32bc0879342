// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/multipath.h"

#include <algorithm>
#include <atomic>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/holograms/robust.h"
#include "tagfield/localization/joint/internal/joint_state.h"
#include "tagfield/localization/joint/internal/traced_search.h"
#include "tagfield/localization/joint/internal/world_fit.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// Positions with a larger expected error are no start [m].
constexpr double kWorstStart = 0.5;
/// Initial search radius around a start [standard deviations].
constexpr double kNear = 2.5;

/// Robust estimates with loose limits, as they are only starts.
std::vector<TagEstimate> robust_estimates(const LocalizationProblem& problem, int threads,
                                          Diagnostics& diagnostics) {
  LocalizationProblem loose = problem;
  loose.limits.max_expected_error_m = std::max(kWorstStart, problem.limits.max_expected_error_m);
  return robust_method().locate(loose, threads, diagnostics).estimates;
}

bool is_reference(const LocalizationProblem& problem, const std::string& tag) {
  return problem.reference_tags.count(tag) > 0;
}

/// Contribution of the world's error to a position's covariance [m²]: the image of an antenna in a
/// surface moves twice as far as the surface, and a tag located by reflections moves with it.
Eigen::Matrix2d of_world(const LocalizationProblem& problem) {
  const double sigma_m = 2.0 * problem.world_sigma_m;
  return sigma_m * sigma_m * Eigen::Matrix2d::Identity();
}

/// Per tag, whether the fit's position is reported.
std::vector<bool> claimed_tags(const WorldFit& fit, const MultipathOptions& options, bool is_right,
                               const std::vector<double>& weights, int threads) {
  const std::vector<Fit> of_tags = fits_of(fit, options, threads);
  std::vector<bool> claimed(of_tags.size());
  for (std::size_t k = 0; k < of_tags.size(); ++k) {
    const bool is_of_world = is_right && fits_somewhat(weights[k]) && is_believable(of_tags[k]);
    claimed[k] = !fit.state.system.tags[k].fixed && (is_of_world || is_settled(of_tags[k]));
  }
  return claimed;
}

/// Takes the joint fit's result where it fits; elsewhere, the robust estimates stay, judged by the
/// requested limits.
void take_estimates(const WorldFit& fit, const std::vector<std::size_t>& numbers,
                    const MultipathOptions& options, int threads, Diagnostics& diagnostics,
                    LocalizationResult& result) {
  const JointState& state = fit.state;
  const LocalizationProblem& problem = *state.problem;
  const std::vector<double> weights = fit_weights(state, threads);
  const bool is_right = is_right_world(weights);
  if (is_right) {
    result.corrected_poses = corrected_poses(problem, state.system.knots, state.system.u);
  } else {
    diagnostics.warn(
        "the phases of most tags don't fit the known world: their reflections are not removed");
  }
  const std::vector<bool> claimed = claimed_tags(fit, options, is_right, weights, threads);
  const bool any = std::find(claimed.begin(), claimed.end(), true) != claimed.end();
  const JointCovariance covariance = any ? covariance_of(state.system, threads) : JointCovariance{};
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    TagEstimate& estimate = result.estimates[numbers[k]];
    if (is_reference(problem, estimate.tag)) continue;
    if (claimed[k]) {
      estimate.reads = static_cast<std::size_t>(state.system.tags[k].phases.size());
      estimate.candidates = {candidate_of(state.system, k, covariance.of_tag[k])};
      add_error(of_world(problem), estimate.candidates.front());
      result.explained[estimate.tag] = fit.straight[k].samples;
    }
    judge(problem.limits, estimate);
  }
}

/// Initial fit, with each tag at its individually likeliest position.
WorldFit begin(const LocalizationProblem& problem, const std::vector<TagEstimate>& estimates,
               const std::vector<std::size_t>& numbers, const MultipathOptions& options,
               int threads) {
  WorldFit fit;
  const double noise_rad = first_noise(problem);
  std::vector<PlacedTag> placed(numbers.size());
  fit.given.resize(numbers.size());
  fit.starts.resize(numbers.size());
  fit.looked_about.resize(numbers.size());
  std::atomic<std::size_t> done{0};
  parallel_for(numbers.size(), threads, [&](std::size_t k) {
    const TagEstimate& estimate = estimates[numbers[k]];
    const SamplesOfTag& samples = problem.samples.at(estimate.tag);
    const Sight sight{samples, samples};
    fit.given[k] = &samples;
    fit.starts[k] = estimate;
    placed[k] = {estimate.tag, &samples,
                 is_reference(problem, estimate.tag)
                     ? problem.reference_tags.at(estimate.tag)
                     : likeliest_position({problem, sight, options.min_directness, noise_rad},
                                          estimate, kNear)};
    tell(problem, "tags in the known world",
         static_cast<double>(++done) / static_cast<double>(numbers.size()));
  });
  fit.state = begin_at(problem, placed);
  return fit;
}

LocalizationResult without_world(const LocalizationProblem& problem) {
  LocalizationResult result;
  result.method = "multipath";
  result.estimates.reserve(problem.samples.size());
  for (const auto& [tag, samples] : problem.samples) {
    const auto known = problem.reference_tags.find(tag);
    result.estimates.push_back(known != problem.reference_tags.end()
                                   ? reference_estimate(tag, known->second)
                                   : not_located(begun(tag, samples),
                                                 "no world is known whose paths could be traced "
                                                 "(give a scenario with model: multipath)"));
  }
  return result;
}

LocalizationResult locate_through_world(const LocalizationProblem& problem, int threads,
                                        Diagnostics& diagnostics, const MultipathOptions& options) {
  if (!problem.trace) return without_world(problem);
  LocalizationResult result;
  result.method = "multipath";
  result.estimates = robust_estimates(problem, threads, diagnostics);
  std::vector<std::size_t> numbers;  // Indices of estimates that serve as starts.
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    if (!result.estimates[i].candidates.empty()) numbers.push_back(i);
  }
  if (numbers.empty()) return result;
  WorldFit fit = begin(problem, result.estimates, numbers, options, threads);
  fit_through_world(fit, options, threads);
  take_estimates(fit, numbers, options, threads, diagnostics, result);
  return result;
}

const OptionTable<MultipathOptions>& multipath_options() {
  using O = MultipathOptions;
  static const OptionTable<O> of{
      {setting<O>("min_directness", "",
                  "minimum share of the direct path in the amplitude of replies that are used",
                  &O::min_directness, {0.0, true, 1.0}),
       setting<O>("rounds", "", "of tracing and fitting", &O::rounds, kAtLeastOne)}};
  return of;
}

}  // namespace

Method multipath_method(const MultipathOptions& options) {
  return method_with("multipath",
                     "all tags and the pose error, without the traced reflections of a known world",
                     multipath_options(), options, locate_through_world);
}

}  // namespace tagfield
