// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/pose_misfit.h"

#include <cmath>

#include "tagfield/localization/fit_candidates.h"

namespace tagfield {
namespace {

constexpr double kAnyOffset = 1e2;  // [m²]

double misfit_of(const TagPhases& phases, const TagPhases::Span& span,
                 const Eigen::ArrayXd& residuals, double white) {
  const PoseErrorModel& model = *phases.pose_error;
  const double slow = model.sigma_m * model.sigma_m;
  Eigen::Vector2d state = Eigen::Vector2d::Zero();  // Pose error and offset.
  Eigen::Matrix2d covariance = Eigen::Vector2d(slow, kAnyOffset).asDiagonal();
  double misfit = 0.0;
  for (Eigen::Index i = span.begin; i < span.begin + span.count; ++i) {
    if (i > span.begin) {
      const double gap_s = std::abs(phases.time_s[i] - phases.time_s[i - 1]);
      const double kept = std::exp(-gap_s / model.time_constant_s);
      state[0] *= kept;
      covariance.row(0) *= kept;
      covariance.col(0) *= kept;
      covariance(0, 0) += slow * (1.0 - kept * kept);
    }
    const Eigen::Vector2d gain = covariance.rowwise().sum();
    const double variance = gain.sum() + white;
    const double innovation = residuals[i] - state.sum();
    misfit += innovation * innovation / variance;
    state += gain / variance * innovation;
    covariance -= gain * gain.transpose() / variance;
  }
  return misfit;
}

}  // namespace

double pose_misfit(const TagPhases& phases, const Eigen::ArrayXd& residuals, double white) {
  double sum = 0.0;
  for (const TagPhases::Span& span : phases.spans) sum += misfit_of(phases, span, residuals, white);
  return sum;
}

bool hides_pose_errors(const TagPhases& phases, const Eigen::ArrayXd& residuals) {
  return phases.pose_error && neighbour_differences(phases, residuals).empty();
}

}  // namespace tagfield
