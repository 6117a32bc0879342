// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/map_error.h"

#include <cmath>

#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// Covariance of the shift of a candidate [m²].
Eigen::Matrix2d shift_at(const MapError& error, const Candidate& candidate) {
  const Eigen::Vector2d arm = candidate.p_WT.head<2>() - *error.origin_W;
  Eigen::Matrix<double, 2, 3> J;
  J << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  return J * error.covariance * J.transpose();
}

}  // namespace

void add_map_error(const LocalizationProblem& problem, LocalizationResult& result) {
  if (!problem.map_error) return;
  if (result.method == "joint" && !problem.reference_tags.empty()) return;
  for (TagEstimate& estimate : result.estimates) {
    if (problem.reference_tags.count(estimate.tag) > 0 || estimate.candidates.empty()) continue;
    // Some methods have their own wider limits.
    const bool was_within =
        estimate.candidates.front().expected_error_m <= problem.limits.max_expected_error_m;
    for (Candidate& candidate : estimate.candidates) {
      add_error(shift_at(*problem.map_error, candidate), candidate);
    }
    if (was_within && estimate.verdict == Verdict::kLocated) judge(problem.limits, estimate);
  }
}

}  // namespace tagfield
