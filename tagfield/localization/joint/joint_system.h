// SPDX-License-Identifier: Apache-2.0
/// @file
/// The normal equations of all tags and the pose error together, and their solution. Tags are
/// coupled through the pose error alone, and that from knot to knot: either the chain of knots is
/// eliminated first, or the tags, whichever is less work.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/joint/pose_knots.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {

/// How a tag's values were straightened (multipath.h): what their bends change by about there, by
/// read, is part of the predicted value.
struct BendSlopes {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();  ///< Where the bends were taken [m],
  Eigen::Matrix2Xd moved;                          ///< with these displacements [m].
  Eigen::Matrix3Xd by_place, by_antenna;           ///< [m/m]
};

/// A tag in the system.
struct JointTag {
  std::string id;
  TagPhases phases;
  HeightModel height;
  bool fixed = false;   ///< Its place is known: a reference tag.
  double weight = 1.0;  ///< Of its reads, 1 for those with the system's noise.
  TagFit fit;           ///< Place and offsets, where the system is linearized.
  // By read: the knot before it (−1 for an antenna without error), and how far towards the next.
  Eigen::ArrayXi knot;
  Eigen::ArrayXi own_knot;  ///< Which of `knots` that is; the next one is there, too.
  Eigen::ArrayXd knot_weight;
  /// By read the antenna's place from its body's reference [m]; empty where all are references.
  Eigen::Array2Xd levers;
  std::optional<BendSlopes> slopes;
  std::vector<Eigen::Index> knots;  ///< That its reads touch, in order.
};

struct JointSystem {
  PoseKnots knots;
  Eigen::VectorXd u;  ///< Pose error in units of its standard deviation; `knots.size` a knot.
  std::vector<JointTag> tags;
  double noise_rad = 0.1;  ///< Of a phase.
};

/// Place of the antenna of the tag's i-th read from its body's reference [m].
inline Eigen::Vector2d lever_of(const JointTag& tag, Eigen::Index i) {
  if (tag.levers.cols() == 0) return Eigen::Vector2d::Zero();
  return tag.levers.col(i);
}

/// Sets `knot`, `levers` and so on for the tag's phases.
void attach(const LocalizationProblem& problem, const PoseKnots& knots, JointTag& tag);

/// How far the believed place of the antenna at the tag's i-th read is off, seen from above [m].
Eigen::Vector2d displacement_at(const JointSystem& system, const JointTag& tag, Eigen::Index i);

/// Σ (residual/noise)² · weight of all reads plus uᵀ Λ u of the pose error. Sets each tag's
/// fit.cost [rad²].
double cost_of(JointSystem& system);

/// Gauss and Newton's method with Levenberg's damping, from where the system stands. Returns the
/// cost there. Threads share the tags.
double minimize(JointSystem& system, int rounds, int threads);

/// What is known at the minimum.
struct JointCovariance {
  /// By tag, of its unknowns; rows of known heights and of fixed tags are 0.
  std::vector<Eigen::Matrix3d> of_tag;
  /// Of all tags' unknowns, 3 rows a tag. Empty where the tags were eliminated first.
  Eigen::MatrixXd of_all;
  double log_determinant = 0.0;  ///< Of the normal equations' matrix.
};
JointCovariance covariance_of(const JointSystem& system, int threads);

/// ln |H| of the normal equations' matrix H alone, where the system stands.
double log_determinant_of(const JointSystem& system, int threads);

/// −2 ln of the data's density given the pose error's model, up to a constant: by this models are
/// compared. `cost` is cost_of() at the minimum.
double evidence(const JointSystem& system, double cost, double log_determinant);

/// Whether to eliminate the chain of knots first, and then to factorize the tags' own matrix, is
/// less work than the other way round, which takes `work_by_tags` multiplications and additions.
bool eliminates_knots_first(Eigen::Index knot_unknowns, Eigen::Index tag_unknowns,
                            double work_by_tags);

}  // namespace tagfield
