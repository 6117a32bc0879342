// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/map_error.h"

#include <fmt/format.h>

#include <utility>

#include "tagfield/localization/judgement.h"

namespace tagfield {

Eigen::Matrix2d shift_at(const Eigen::Vector2d& origin, const Eigen::Matrix3d& covariance,
                         const Eigen::Vector2d& p) {
  const Eigen::Vector2d arm = p - origin;
  Eigen::Matrix<double, 2, 3> J;
  J << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  return J * covariance * J.transpose();
}

void add_shifts(const LocalizationProblem& problem, const std::string& cause,
                const std::function<Eigen::Matrix2d(const std::string& tag,
                                                    const Eigen::Vector2d& p_WT)>& shift_of,
                LocalizationResult& result) {
  for (TagEstimate& estimate : result.estimates) {
    if (problem.reference_tags.count(estimate.tag) > 0 || estimate.candidates.empty()) continue;
    // Some methods have their own wider limits.
    const bool was_within =
        estimate.candidates.front().expected_error_m <= problem.limits.max_expected_error_m;
    for (Candidate& candidate : estimate.candidates) {
      add_error(shift_of(estimate.tag, candidate.p_WT.head<2>()), candidate);
    }
    const double expected_m = estimate.candidates.front().expected_error_m;
    const double limit_m = problem.limits.max_expected_error_m;
    if (!was_within || estimate.verdict != Verdict::kLocated || expected_m <= limit_m) continue;
    estimate = not_located(std::move(estimate),
                           fmt::format("{} leaves it uncertain by {:.2f} m, limit {:.2f} m", cause,
                                       expected_m, limit_m));
  }
}

void add_map_error(const LocalizationProblem& problem, LocalizationResult& result) {
  if (!problem.map_error) return;
  if (result.method == "joint" && !problem.reference_tags.empty()) return;
  const MapError& error = *problem.map_error;
  const auto of_map = [&](const std::string&, const Eigen::Vector2d& p_WT) {
    return shift_at(*error.origin_W, error.covariance, p_WT);
  };
  add_shifts(problem, "the error of the map", of_map, result);
}

}  // namespace tagfield
