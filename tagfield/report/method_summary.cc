// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/method_summary.h"

#include <algorithm>
#include <map>

#include "tagfield/report/alignment.h"

namespace tagfield {
namespace {

constexpr std::size_t kFewestToAlign = 3;  // Two could be aligned except for their distance.

using Outcomes = std::vector<const TagOutcome*>;

const Eigen::Vector3d& place_of(const TagOutcome& outcome) {
  return outcome.estimate.candidates.front().p_WT;
}

/// Outcomes that have an error, by seed.
std::map<std::uint64_t, Outcomes> judged_by_seed(const std::vector<TagOutcome>& outcomes) {
  std::map<std::uint64_t, Outcomes> by_seed;
  for (const TagOutcome& outcome : outcomes) {
    if (error_of(outcome)) by_seed[outcome.seed].push_back(&outcome);
  }
  return by_seed;
}

PlanarMotion motion_to_truth(const Outcomes& outcomes) {
  std::vector<Eigen::Vector2d> from;
  std::vector<Eigen::Vector2d> to;
  for (const TagOutcome* outcome : outcomes) {
    from.emplace_back(place_of(*outcome).head<2>());
    to.emplace_back(outcome->truth_m->head<2>());
  }
  return best_motion(from, to);
}

std::size_t count_of(const std::vector<TagOutcome>& outcomes, Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(), [verdict](const TagOutcome& outcome) {
        return !outcome.reference && outcome.estimate.verdict == verdict;
      }));
}

}  // namespace

std::vector<double> aligned_errors(const std::vector<TagOutcome>& outcomes) {
  std::vector<double> errors;
  for (const auto& [seed, of_seed] : judged_by_seed(outcomes)) {
    if (of_seed.size() < kFewestToAlign) continue;
    const PlanarMotion motion = motion_to_truth(of_seed);
    for (const TagOutcome* outcome : of_seed) {
      Eigen::Vector3d aligned = place_of(*outcome);
      aligned.head<2>() = motion * Eigen::Vector2d(aligned.head<2>());
      errors.push_back((aligned - *outcome->truth_m).norm());
    }
  }
  return errors;
}

MethodSummary summary_of_method(const std::string& method, const std::vector<TagOutcome>& outcomes,
                                bool align) {
  std::vector<double> errors;
  for (const TagOutcome& outcome : outcomes) {
    if (const auto error = error_of(outcome)) errors.push_back(*error);
  }
  MethodSummary summary;
  summary.method = method;
  summary.located = count_of(outcomes, Verdict::kLocated);
  summary.ambiguous = count_of(outcomes, Verdict::kAmbiguous);
  summary.not_located = count_of(outcomes, Verdict::kNotLocated);
  summary.error_m = statistics(std::move(errors));
  if (align) summary.aligned_error_m = statistics(aligned_errors(outcomes));
  return summary;
}

}  // namespace tagfield
