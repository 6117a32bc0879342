// SPDX-License-Identifier: Apache-2.0
/// @file
/// Normal equations of all tags and the pose error, and their solution. Tags are coupled only
/// through the pose error, which is coupled from knot to knot: either the chain of knots or the
/// tags are eliminated first, whichever is less work.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/joint/pose_knots.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {

/// Linearization of the bends removed from a tag's values (multipath.h), per read: the change of a
/// bend away from its reference point is part of the predicted value.
struct BendSlopes {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();  ///< Where the bends were computed [m],
  Eigen::Matrix2Xd moved;                          ///< with these displacements [m].
  Eigen::Matrix3Xd by_place, by_antenna;           ///< [m/m]
};

/// A tag in the system.
struct JointTag {
  std::string id;
  TagPhases phases;
  HeightModel height;
  bool fixed = false;   ///< Reference tag: its position is known.
  double weight = 1.0;  ///< Of its reads; 1 if they have the system's noise.
  TagFit fit;           ///< Position and offsets at the linearization point.
  // Per read: the knot before it (−1 for an antenna without error), and the fraction towards the
  // next.
  Eigen::ArrayXi knot;
  Eigen::ArrayXi own_knot;  ///< Its index in `knots`, followed there by the next knot.
  Eigen::ArrayXd knot_weight;
  /// Per read, position of the antenna relative to its body's reference [m]; empty if all are
  /// references.
  Eigen::Array2Xd levers;
  std::optional<BendSlopes> slopes;
  std::vector<Eigen::Index> knots;  ///< Knots that its reads depend on, in ascending order.
};

struct JointSystem {
  PoseKnots knots;
  Eigen::VectorXd u;  ///< Pose error in standard deviations; `knots.size` entries per knot.
  std::vector<JointTag> tags;
  double noise_rad = 0.1;  ///< Of a phase.
};

/// Position of the antenna of the tag's i-th read relative to its body's reference [m].
inline Eigen::Vector2d lever_of(const JointTag& tag, Eigen::Index i) {
  if (tag.levers.cols() == 0) return Eigen::Vector2d::Zero();
  return tag.levers.col(i);
}

/// Sets `knot`, `levers` and so on for the tag's phases.
void attach(const LocalizationProblem& problem, const PoseKnots& knots, JointTag& tag);

/// Error of the body's believed pose at the tag's i-th read: x, y [m] and yaw [rad], which is 0 if
/// it is not estimated.
Eigen::Vector3d pose_error_at(const JointSystem& system, const JointTag& tag, Eigen::Index i);

/// Horizontal error of the antenna's believed position at the tag's i-th read [m].
Eigen::Vector2d displacement_at(const JointSystem& system, const JointTag& tag, Eigen::Index i);

/// Σ (residual/noise)² · weight over all reads plus uᵀ Λ u of the pose error. Sets each tag's
/// fit.cost [rad²].
double cost_of(JointSystem& system);

/// Minimizes the cost by Gauss-Newton with Levenberg's damping, starting from the current state.
/// Returns the final cost. The tags are distributed over threads.
double minimize(JointSystem& system, int rounds, int threads);

/// Covariance at the minimum.
struct JointCovariance {
  /// Per tag, of its unknowns; rows of known heights and of fixed tags are 0.
  std::vector<Eigen::Matrix3d> of_tag;
  /// Of all tags' unknowns, 3 rows per tag. Empty if the tags were eliminated first.
  Eigen::MatrixXd of_all;
  double log_determinant = 0.0;  ///< Of the normal equations' matrix.
};
JointCovariance covariance_of(const JointSystem& system, int threads);

/// Only ln |H| of the normal equations' matrix H, at the current state.
double log_determinant_of(const JointSystem& system, int threads);

/// −2 ln of the density of the data given the pose-error model, up to a constant, for model
/// comparison. `cost` is cost_of() at the minimum. Not for dead reckoning, whose model is known.
double evidence(const JointSystem& system, double cost, double log_determinant);

/// Whether eliminating the chain of knots first and then factorizing the tags' matrix is less work
/// than the reverse, which takes `work_by_tags` multiply-adds.
bool eliminates_knots_first(Eigen::Index knot_unknowns, Eigen::Index tag_unknowns,
                            double work_by_tags);

}  // namespace tagfield
