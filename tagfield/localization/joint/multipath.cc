// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/multipath.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tagfield/base/parallel.h"
#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/robust.h"
#include "tagfield/localization/joint/internal/joint_state.h"
#include "tagfield/localization/joint/internal/traced_search.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

/// Places worse than this are no start [m].
constexpr double kWorstStart = 0.5;
/// Deviations of a start, within which its tag is looked for at first.
constexpr double kNear = 2.5;

/// A run of the method under way.
struct Run {
  JointState state;
  std::vector<TagEstimate> starts;         ///< By tag of the state, as are
  std::vector<const SamplesOfTag*> given;  ///< the samples as they were measured,
  std::vector<Straightened> straight;      ///< and without their bends;
  /// and whether there was a look about where it is (by several threads, so no vector<bool>).
  std::vector<char> looked_about;
};

/// Robust estimates, loosely limited: they are but starts.
std::vector<TagEstimate> robust_estimates(const LocalizationProblem& problem, int threads,
                                          Diagnostics& diagnostics) {
  LocalizationProblem loose = problem;
  loose.limits.max_expected_error_m = std::max(kWorstStart, problem.limits.max_expected_error_m);
  return robust_method().locate(loose, threads, diagnostics).estimates;
}

Sight sight_of(const JointState& state, const SamplesOfTag& samples) {
  return {samples, corrected_samples(*state.problem, state.system.knots, state.system.u, samples)};
}

/// By phase of a tag whose samples these are; an antenna reads a tag once at a time.
BendSlopes slopes_of(const JointState& state, const JointTag& tag, const Straightened& straight) {
  std::map<std::pair<std::string, double>, const Bend*> bends;
  for (const auto& [antenna, series] : straight.samples) {
    const std::vector<Bend>& of_antenna = straight.bends.at(antenna);
    for (std::size_t i = 0; i < series.size(); ++i) {
      bends[{antenna, to_seconds(series[i].stamp)}] = &of_antenna[i];
    }
  }
  BendSlopes slopes;
  slopes.p_WT = to_place(tag.height, tag.fit.unknowns);
  slopes.moved.resize(2, tag.phases.size());
  slopes.by_place.resize(3, tag.phases.size());
  slopes.by_antenna.resize(3, tag.phases.size());
  for (const TagPhases::Span& span : tag.phases.spans) {
    for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
      const Bend& bend = *bends.at({span.antenna, tag.phases.time_s[i]});
      slopes.moved.col(i) = displacement_at(state.system, tag, i);
      slopes.by_place.col(i) = bend.by_place;
      slopes.by_antenna.col(i) = bend.by_antenna;
    }
  }
  return slopes;
}

/// Takes the bends out where the state stands.
void straighten_all(Run& run, const MultipathOptions& options, int threads) {
  JointState& state = run.state;
  const LocalizationProblem& problem = *state.problem;
  std::vector<Straightened> next(run.given.size());
  parallel_for(run.given.size(), threads, [&](std::size_t i) {
    const JointTag& tag = state.system.tags[i];
    const Sight sight = sight_of(state, *run.given[i]);
    const Vector3d p = to_place(tag.height, tag.fit.unknowns);
    next[i] = straightened(problem, sight, traced(problem, tag.id, sight.corrected, p), p,
                           options.least_directness, state.system.noise_rad);
  });
  run.straight = std::move(next);
  for (std::size_t i = 0; i < run.straight.size(); ++i) {
    take_samples(state, i, run.straight[i].samples);
    JointTag& tag = state.system.tags[i];
    tag.slopes = slopes_of(state, tag, run.straight[i]);
  }
}

std::vector<Vector3d> places_of(const JointState& state) {
  std::vector<Vector3d> places;
  places.reserve(state.system.tags.size());
  for (const JointTag& tag : state.system.tags) {
    places.push_back(to_place(tag.height, tag.fit.unknowns));
  }
  return places;
}

double farthest_move(const std::vector<Vector3d>& before, const std::vector<Vector3d>& after) {
  double most = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    most = std::max(most, (after[i] - before[i]).norm());
  }
  return most;
}

/// Of the waves that add up at the tag's place with the corrected poses, less their bends.
double share_at(const JointState& state, std::size_t index) {
  const JointTag& tag = state.system.tags[index];
  const TagPhases phases =
      coherent_reads(*state.problem, sight_of(state, *state.samples[index]).corrected);
  return coherent_share(phases, tag.height, tag.fit.unknowns);
}

/// Less is a wrong place, or a wrong world: noise alone leaves e^(−σ²/2).
double least_share(const JointState& state) {
  constexpr double kOfNoiseAlone = 0.85;
  return kOfNoiseAlone * std::exp(-0.5 * state.system.noise_rad * state.system.noise_rad);
}

/// Less is no fit.
constexpr double kFits = 0.1;

/// For how much a tag's reads count in the fit, of 1 where only their noise is left; 0 where its
/// waves don't add up.
double fit_weight(const JointState& state, std::size_t index) {
  const bool adds_up = share_at(state, index) >= least_share(state);
  return adds_up ? state.system.tags[index].weight : 0.0;
}

std::vector<double> fit_weights(const JointState& state, int threads) {
  std::vector<double> weights(state.system.tags.size());
  parallel_for(weights.size(), threads, [&](std::size_t i) { weights[i] = fit_weight(state, i); });
  return weights;
}

/// A wrong world fits a tag here and there, a right one most.
bool is_right_world(const std::vector<double>& weights) {
  constexpr double kFitsWell = 0.2;
  const auto fitting = std::count_if(weights.begin(), weights.end(),
                                     [](double weight) { return weight >= kFitsWell; });
  return 2 * static_cast<std::size_t>(fitting) >= weights.size();
}

bool any_fits(const std::vector<double>& weights) {
  return std::any_of(weights.begin(), weights.end(), [](double weight) { return weight >= kFits; });
}

/// How far from its starts a tag that doesn't fit is looked for.
enum class Reach { kFurther, kAnywhere };

TracedSearch search_for(const JointState& state, const Sight& sight,
                        const MultipathOptions& options) {
  return {*state.problem, sight, options.least_directness, state.system.noise_rad};
}

/// Tags that don't fit are looked for anew, now that others tell the pose error.
void find_lost(Run& run, const MultipathOptions& options, Reach reach, int threads) {
  constexpr double kFurther = 5.0;  // Deviations.
  JointState& state = run.state;
  parallel_for(run.given.size(), threads, [&](std::size_t i) {
    JointTag& tag = state.system.tags[i];
    if (tag.fixed || fit_weight(state, i) >= kFits) return;
    const Sight sight = sight_of(state, *run.given[i]);
    const TracedSearch search = search_for(state, sight, options);
    const Vector3d there =
        reach == Reach::kFurther
            ? likeliest_place(search, run.starts[i], kFurther)
            : likeliest_anywhere(search, tag.id, run.starts[i].candidates.front().p_WT);
    tag.fit.unknowns = to_unknowns(tag.height, there);
    run.looked_about[i] = 0;
  });
}

/// A step of the joint fit can lead over a ridge of a likelihood with many peaks, and a search end
/// on a lesser one: each tag that leaves more than noise goes on from the best place about where it
/// was and where it is, and once, late on, further about that, if it is clearly better.
void climb_all(Run& run, const std::vector<Vector3d>& before, const MultipathOptions& options,
               bool is_late, int threads) {
  constexpr double kAbout = 0.3;    // [m]
  constexpr double kClearly = 6.0;  // Less of the cost.
  constexpr double kFar = 0.01;     // [m]
  JointState& state = run.state;
  parallel_for(run.given.size(), threads, [&](std::size_t i) {
    JointTag& tag = state.system.tags[i];
    if (tag.fixed) return;
    const Sight sight = sight_of(state, *run.given[i]);
    const TracedSearch search = search_for(state, sight, options);
    const Vector3d now = to_place(tag.height, tag.fit.unknowns);
    const Fit here = fit_at(search, tag.id, now);
    if (is_settled(here)) return;
    std::vector<Vector3d> places{now};
    if ((before[i] - now).norm() > kFar) places.push_back(before[i]);
    if (is_late && run.looked_about[i] == 0 && fit_weight(state, i) >= kFits) {
      run.looked_about[i] = 1;
      for (const LikelyPlace& about : likeliest_about(search, tag.id, now, kAbout).places) {
        places.push_back(about.p_WT);
      }
    }
    double best = here.cost - kClearly;
    for (const Vector3d& place : places) {
      const Vector3d there = climbed(search, tag.id, place).p_WT;
      const double cost = fit_at(search, tag.id, there).cost;
      if (cost >= best) continue;
      best = cost;
      tag.fit.unknowns = to_unknowns(tag.height, there);
    }
  });
}

/// Traces and fits, again and again.
void fit_through_world(Run& run, const MultipathOptions& options, int threads) {
  constexpr double kSettled = 3e-4;  // [m]
  JointState& state = run.state;
  for (int round = 0; round < options.rounds; ++round) {
    const std::vector<Vector3d> before = places_of(state);
    straighten_all(run, options, threads);
    fit_unwrapped_jointly(state, threads);
    climb_all(run, before, options, round > 2, threads);
    if (round == 1 && !state.problem->pose_error) learn_pose_error(state, threads);
    if (round == 2) {
      // The reads of no tag fit this world: it is another one, or they are not what they seem.
      if (!any_fits(fit_weights(state, threads))) break;
      find_lost(run, options, Reach::kFurther, threads);
    } else if (round == 4 && is_right_world(fit_weights(state, threads))) {
      find_lost(run, options, Reach::kAnywhere, threads);
    } else if (round > 1 && farthest_move(before, places_of(state)) < kSettled) {
      break;
    }
  }
}

bool is_reference(const LocalizationProblem& problem, const std::string& tag) {
  return problem.reference_tags.count(tag) > 0;
}

/// What the world's error adds to a place's covariance [m²]: the image of an antenna in a surface
/// moves twice as far as the surface, and a tag that reflections hold goes along.
Eigen::Matrix2d of_world(const LocalizationProblem& problem) {
  const double sigma_m = 2.0 * problem.world_sigma_m;
  return sigma_m * sigma_m * Eigen::Matrix2d::Identity();
}

std::vector<Fit> fits_of(const Run& run, const MultipathOptions& options, int threads) {
  const JointState& state = run.state;
  std::vector<Fit> fits(run.given.size());
  parallel_for(fits.size(), threads, [&](std::size_t i) {
    const JointTag& tag = state.system.tags[i];
    const Sight sight = sight_of(state, *run.given[i]);
    fits[i] =
        fit_at(search_for(state, sight, options), tag.id, to_place(tag.height, tag.fit.unknowns));
  });
  return fits;
}

/// What the joint fit says where it fits; else the robust estimates stay, by the limits that were
/// asked for.
void take_estimates(const Run& run, const std::vector<std::size_t>& numbers,
                    const MultipathOptions& options, int threads, Diagnostics& diagnostics,
                    LocalizationResult& result) {
  const JointState& state = run.state;
  const LocalizationProblem& problem = *state.problem;
  const std::vector<double> weights = fit_weights(state, threads);
  const bool is_right = is_right_world(weights);
  const std::vector<Fit> fits = fits_of(run, options, threads);
  const JointCovariance covariance = covariance_of(state.system, threads);
  if (is_right) {
    result.corrected_poses = corrected_poses(problem, state.system.knots, state.system.u);
  } else {
    diagnostics.warn(
        "the phases of most tags don't fit the known world: their reflections are not taken out");
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    TagEstimate& estimate = result.estimates[numbers[k]];
    if (is_reference(problem, estimate.tag)) continue;
    const bool fits_somewhat = is_right && weights[k] >= kFits && is_believable(fits[k]);
    if (fits_somewhat || is_settled(fits[k])) {
      estimate.reads = static_cast<std::size_t>(state.system.tags[k].phases.size());
      estimate.candidates = {candidate_of(state.system, k, covariance.of_tag[k])};
      add_error(of_world(problem), estimate.candidates.front());
      result.explained[estimate.tag] = run.straight[k].samples;
    }
    judge(problem.limits, estimate);
  }
}

/// The run with each tag at its likeliest place by itself.
Run begin(const LocalizationProblem& problem, const std::vector<TagEstimate>& estimates,
          const std::vector<std::size_t>& numbers, const MultipathOptions& options, int threads) {
  Run run;
  const double noise_rad = first_noise(problem);
  std::vector<PlacedTag> placed(numbers.size());
  run.given.resize(numbers.size());
  run.starts.resize(numbers.size());
  run.looked_about.resize(numbers.size());
  parallel_for(numbers.size(), threads, [&](std::size_t k) {
    const TagEstimate& estimate = estimates[numbers[k]];
    const SamplesOfTag& samples = problem.samples.at(estimate.tag);
    const Sight sight{samples, samples};
    run.given[k] = &samples;
    run.starts[k] = estimate;
    placed[k] = {estimate.tag, &samples,
                 is_reference(problem, estimate.tag)
                     ? problem.reference_tags.at(estimate.tag)
                     : likeliest_place({problem, sight, options.least_directness, noise_rad},
                                       estimate, kNear)};
  });
  run.state = begin_at(problem, placed);
  return run;
}

LocalizationResult without_world(const LocalizationProblem& problem) {
  LocalizationResult result;
  result.method = "multipath";
  result.estimates.reserve(problem.samples.size());
  for (const auto& [tag, samples] : problem.samples) {
    const auto known = problem.reference_tags.find(tag);
    result.estimates.push_back(
        known != problem.reference_tags.end()
            ? reference_estimate(tag, known->second)
            : not_located(begun(tag, samples),
                          "no world is known whose paths could be traced (a scenario with "
                          "model: multipath tells it)"));
  }
  return result;
}

LocalizationResult locate_through_world(const LocalizationProblem& problem, int threads,
                                        Diagnostics& diagnostics, const MultipathOptions& options) {
  if (!problem.trace) return without_world(problem);
  LocalizationResult result;
  result.method = "multipath";
  result.estimates = robust_estimates(problem, threads, diagnostics);
  std::vector<std::size_t> numbers;  // Of estimates that are a start.
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    if (!result.estimates[i].candidates.empty()) numbers.push_back(i);
  }
  if (numbers.empty()) return result;
  Run run = begin(problem, result.estimates, numbers, options, threads);
  fit_through_world(run, options, threads);
  take_estimates(run, numbers, options, threads, diagnostics, result);
  return result;
}

const OptionTable<MultipathOptions>& multipath_options() {
  using O = MultipathOptions;
  static const OptionTable<O> of{
      {setting<O>("least_directness", "", "share of the direct path's amplitude in replies in use",
                  &O::least_directness, {0.0, true, 1.0}),
       setting<O>("rounds", "", "of tracing and fitting", &O::rounds, kAtLeastOne)}};
  return of;
}

}  // namespace

Method multipath_method(const MultipathOptions& options) {
  return method_with("multipath",
                     "all tags and the pose error, less the traced reflections of a known world",
                     multipath_options(), options, locate_through_world);
}

}  // namespace tagfield
