// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/drift_steps.h"

#include <Eigen/LU>
#include <algorithm>

#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// u is in hundredths of a metre and of a radian, of the order of the errors.
constexpr double kUnit = 0.01;
/// A step's least standard deviation [m, rad], so that its covariance has an inverse where nothing
/// is driven; in a thousand steps 0.3 mm.
constexpr double kLeast = 1e-5;

/// Error at a place due to a shift and a turn about another, `arm` before it.
Eigen::Matrix3d moved_by(const Eigen::Vector2d& arm) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = -arm.y();
  F(1, 2) = arm.x();
  return F;
}

/// Covariance at `place` of what dead reckoning gains from one time to another.
Eigen::Matrix3d gained(const std::vector<Drift>& drift, double from_s, double to_s,
                       const Eigen::Vector2d& place) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  auto after = std::upper_bound(
      drift.begin(), drift.end(), from_s,
      [](double time_s, const Drift& entry) { return time_s < to_seconds(entry.stamp); });
  for (; after != drift.end(); ++after) {
    if (after == drift.begin()) continue;
    const double begin_s = to_seconds((after - 1)->stamp);
    if (begin_s >= to_s) break;
    const double end_s = to_seconds(after->stamp);
    const double share = (std::min(end_s, to_s) - std::max(begin_s, from_s)) / (end_s - begin_s);
    const Eigen::Matrix3d J = moved_by(place - after->origin_W);
    sum += share * (J * after->since_last * J.transpose());
  }
  return sum;
}

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
      step.precision = precision_of(gained(drift, last_s, time_s, place));
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
