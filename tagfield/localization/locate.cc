// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/locate.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "tagfield/localization/aim.h"
#include "tagfield/localization/at_rest.h"
#include "tagfield/localization/automatic.h"
#include "tagfield/localization/circular_polarization.h"
#include "tagfield/localization/common_latency.h"
#include "tagfield/localization/confirmation.h"
#include "tagfield/localization/drift.h"
#include "tagfield/localization/fixed/fixed.h"
#include "tagfield/localization/height_side.h"
#include "tagfield/localization/holograms/dah.h"
#include "tagfield/localization/holograms/particle.h"
#include "tagfield/localization/holograms/robust.h"
#include "tagfield/localization/holograms/sar.h"
#include "tagfield/localization/interleaved_tags.h"
#include "tagfield/localization/joint/joint.h"
#include "tagfield/localization/joint/multipath.h"
#include "tagfield/localization/judgement.h"
#include "tagfield/localization/jumping_bodies.h"
#include "tagfield/localization/map_error.h"
#include "tagfield/localization/mirror_rivals.h"
#include "tagfield/localization/outliers.h"
#include "tagfield/localization/phase_curves/hyperbola.h"
#include "tagfield/localization/phase_curves/least_squares.h"
#include "tagfield/localization/phase_curves/maximum_likelihood.h"
#include "tagfield/localization/phase_groups.h"
#include "tagfield/localization/plausibility.h"
#include "tagfield/localization/scan/scan.h"
#include "tagfield/localization/signal_strength/landmarc.h"
#include "tagfield/localization/signal_strength/trilateration.h"

namespace tagfield {
namespace {

PathLine way_of(const SamplesOfTag& samples) {
  std::vector<Eigen::Vector2d> places;
  for (const auto& [antenna, series] : samples) {
    for (const PhaseSample& sample : series) places.emplace_back(sample.p_WA.head<2>());
  }
  return path_line(places);
}

void keep_within_area(const LocalizationProblem& problem, std::vector<TagEstimate>& estimates) {
  if (!problem.area.side && !problem.area.box) return;
  for (TagEstimate& estimate : estimates) {
    const auto samples = problem.samples.find(estimate.tag);
    if (samples == problem.samples.end() || estimate.candidates.empty()) continue;
    if (problem.reference_tags.count(estimate.tag) > 0) continue;
    const double most =
        std::max(problem.limits.max_expected_error_m, estimate.candidates.front().expected_error_m);
    keep_within(problem.area, way_of(samples->second), most, estimate);
  }
}

}  // namespace

std::vector<Method> built_in_methods() {
  std::vector<Method> methods = {
      hyperbola_method(), least_squares_method(), maximum_likelihood_method(),
      joint_method(),     multipath_method(),     sar_method(),
      robust_method(),    dah_method(),           particle_method(),
      scan_method(),      trilateration_method(), fixed_method(),
      landmarc_method(),
  };
  methods.insert(methods.begin(), automatic_method(methods));
  return methods;
}

bool is_by_phase(const std::string& method) {
  constexpr const char* kByPhase[] = {"hyperbola", "least_squares", "ml",  "joint",    "multipath",
                                      "sar",       "robust",        "dah", "particle", "scan"};
  return std::any_of(std::begin(kByPhase), std::end(kByPhase),
                     [&](const char* name) { return method == name; });
}

namespace {

/// The problem against which positions are checked: samples without what the method's model
/// explains.
LocalizationProblem less_explained(const LocalizationProblem& problem,
                                   const LocalizationResult& result) {
  LocalizationProblem less = problem;
  for (const auto& [tag, samples] : result.explained) less.samples[tag] = samples;
  return less;
}

/// Whether a method unwraps phases from read to read.
bool unwraps(const std::string& method) {
  return method == "hyperbola" || method == "least_squares" || method == "ml" || method == "joint";
}

/// The method's result. Arbitrary phases are left out where they would shift others by whole
/// cycles; positions are checked against all reads.
LocalizationResult located_by(const Method& method, LocalizationProblem& problem, int threads,
                              Diagnostics& diagnostics) {
  std::optional<WithoutStrayPhases> cleaned;
  if (unwraps(method.name) && problem.has_phases) cleaned.emplace(problem, threads, diagnostics);
  return method.locate(problem, threads, diagnostics);
}

/// Refuses what no method may claim.
LocalizationResult held_against(const LocalizationProblem& problem, LocalizationResult result,
                                int threads, Diagnostics& diagnostics) {
  if (is_by_phase(result.method) && !problem.has_phases) {
    refuse_without_phases(problem, result);
  } else if (is_by_phase(result.method)) {
    refuse_drifting(problem, result, diagnostics);
    if (result.method != "multipath") add_mirror_images(problem, threads, result);
    drop_candidates_behind(problem, result);
    refuse_chance(problem, result);
    refuse_mixtures(problem, result);
    refuse_unconfirmed(problem, threads, result);
    span_line(problem, result);
    refuse_wrong_sign(problem, result, diagnostics);
    refuse_swapped_antennas(problem, result, diagnostics);
    refuse_common_latency(problem, threads, result, diagnostics);
  } else if (problem.has_phases) {
    refuse_mixtures_by_phase(problem, result);
    refuse_groups(problem, result);
  }
  if (problem.has_phases) refuse_interleaved_tags(problem, result);
  if (problem.has_phases) refuse_departures(problem, threads, result, diagnostics);
  add_map_error(problem, result);
  add_drift(problem, result);
  add_pose_jumps(problem, result);
  keep_on_height_side(problem, result);
  keep_within_area(problem, result.estimates);
  return result;
}

LocalizationResult checked(const LocalizationProblem& problem, LocalizationResult result,
                           int threads, Diagnostics& diagnostics) {
  if (result.explained.empty()) {
    return held_against(problem, std::move(result), threads, diagnostics);
  }
  const LocalizationProblem less = less_explained(problem, result);
  return held_against(less, std::move(result), threads, diagnostics);
}

/// Factor on the limit of the expected error with which tags are located though rotations of the
/// phase leave residuals that, as slow errors, double the expected error.
constexpr double kLenient = 2.0;

/// Applies the problem's limits to positions by phase; those by RSSI have others.
void judge_again(const LocalizationProblem& problem, LocalizationResult& result) {
  if (!is_by_phase(result.method)) return;
  for (TagEstimate& estimate : result.estimates) {
    if (estimate.verdict != Verdict::kLocated) continue;
    if (problem.reference_tags.count(estimate.tag) == 0) judge(problem.limits, estimate);
  }
}

/// Whether a method estimates the pose error if none is stated.
bool learns_pose_error(const std::string& method) {
  return method == "joint" || method == "multipath";
}

bool has_located(const LocalizationProblem& problem, const LocalizationResult& result) {
  return std::any_of(result.estimates.begin(), result.estimates.end(), [&](const TagEstimate& of) {
    return !of.candidates.empty() && problem.reference_tags.count(of.tag) == 0;
  });
}

/// Positions by RSSI are so much worse than poses that the pose error does not matter; by phase
/// nothing is located if no antenna moved (why_not_locatable()).
void warn_of_unknown_pose_error(const LocalizationProblem& problem,
                                const LocalizationResult& result, Diagnostics& diagnostics) {
  if (problem.pose_error || !is_by_phase(result.method) || learns_pose_error(result.method)) return;
  if (!has_located(problem, result)) return;
  const bool has_covariances =
      std::any_of(problem.tracks.begin(), problem.tracks.end(),
                  [](const auto& of) { return !of.second.covariance.empty(); });
  diagnostics.warn(fmt::format(
      "{}, and '{}' takes them as exact: if they are not, positions are further off than the "
      "expected errors say. Give their error (0 if they are exact), or use 'joint', which {}",
      has_covariances ? "the poses' covariances are not used" : "the poses' error is not stated",
      result.method, has_covariances ? "uses them" : "estimates it"));
}

}  // namespace

LocalizationResult locate_problem(const Method& method, LocalizationProblem& problem, int threads,
                                  Diagnostics& diagnostics) {
  if (problem.circular.empty() || !problem.has_phases) {
    return checked(problem, located_by(method, problem, threads, diagnostics), threads,
                   diagnostics);
  }
  // A first position from the uncorrected phases is needed to estimate how the tags' wires rotate
  // them.
  Diagnostics of_first;
  const double max_expected_error_m = problem.limits.max_expected_error_m;
  problem.limits.max_expected_error_m *= kLenient;
  LocalizationResult result = located_by(method, problem, threads, of_first);
  problem.limits.max_expected_error_m = max_expected_error_m;
  // Traced replies already include these rotations.
  const bool is_blind = is_by_phase(result.method) && result.explained.empty();
  const PolarizationAllowances allowances =
      is_blind ? allow_for_polarization(problem, result, threads) : PolarizationAllowances{};
  const bool any_turned = std::any_of(allowances.begin(), allowances.end(),
                                      [](const auto& of) { return of.second.samples.has_value(); });
  if (!any_turned) {
    for (const std::string& warning : of_first.warnings()) diagnostics.warn(warning);
    judge_again(problem, result);
    add_polarization_error(allowances, problem.limits, result);
    return checked(problem, std::move(result), threads, diagnostics);
  }
  LocalizationProblem turned = problem;
  for (const auto& [tag, allowance] : allowances) {
    if (allowance.samples) turned.samples[tag] = *allowance.samples;
  }
  result = located_by(method, turned, threads, diagnostics);
  add_polarization_error(allowances, problem.limits, result);
  return checked(turned, std::move(result), threads, diagnostics);
}

LocalizationResult locate_tags(const std::vector<TagRead>& reads,
                               const std::vector<AntennaPose>& poses,
                               const LocalizationOptions& options, Diagnostics& diagnostics) {
  return locate_tags(each_of(reads), poses, options, diagnostics);
}

LocalizationResult locate_tags(const EachRead& each_read, const std::vector<AntennaPose>& poses,
                               const LocalizationOptions& options, Diagnostics& diagnostics) {
  const Method method = configured(find_method(options.methods, options.method), options.settings);
  LocalizationProblem problem = make_problem(each_read, poses, options.known, diagnostics);
  problem.on_locating = options.on_locating;
  LocalizationResult result = locate_problem(method, problem, options.threads, diagnostics);
  warn_of_unknown_pose_error(problem, result, diagnostics);
  return result;
}

}  // namespace tagfield
