// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/drift_steps.h"

#include <Eigen/LU>
#include <algorithm>

#include "tagfield/localization/drift.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// u is in hundredths of a metre and of a radian, of the order of the errors.
constexpr double kUnit = 0.01;
/// A step's least standard deviation [m, rad], so that its covariance has an inverse where nothing
/// is driven; in a thousand steps 0.3 mm.
constexpr double kLeast = 1e-5;

Eigen::Matrix3d precision_of(Eigen::Matrix3d covariance) {
  covariance.diagonal().array() += kLeast * kLeast;
  const Eigen::Matrix3d inverse = covariance.inverse();
  return 0.5 * (inverse + inverse.transpose());
}

/// Appends the steps of one body's knots.
void add_steps(const LocalizationProblem& problem, const PoseKnots::Chain& chain,
               std::vector<KnotStep>& steps) {
  const std::vector<Drift>& drift = problem.drift.at(chain.reference);
  const Trajectory& track = problem.tracks.at(chain.reference).X_WA;
  KnotStep step;
  step.is_first = true;
  double last_s = to_seconds(drift.front().stamp);
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  for (const PoseKnots::Piece& piece : chain.pieces) {
    for (Eigen::Index k = 0; k < piece.count; ++k) {
      const double time_s = piece.begin_s + static_cast<double>(k) * piece.spacing_s;
      const Eigen::Vector2d place = held_position_at(track, time_from_seconds(time_s)).head<2>();
      if (!step.is_first) step.driven = place - last;
      step.precision = precision_of(drift_between(drift, last_s, time_s, place));
      steps.push_back(step);
      step.is_first = false;
      last_s = time_s;
      last = place;
    }
  }
}

}  // namespace

void take_drift(const LocalizationProblem& problem, PoseKnots& knots) {
  knots.size = 3;
  knots.time_constant_s = 1e6;  // In pauses the error goes on linearly.
  for (Eigen::Matrix3d& scale : knots.scale) scale = kUnit * Eigen::Matrix3d::Identity();
  knots.steps.reserve(knots.scale.size());
  for (const PoseKnots::Chain& chain : knots.chains) add_steps(problem, chain, knots.steps);
}

}  // namespace tagfield
