// SPDX-License-Identifier: Apache-2.0
/// @file
/// Solution of a JointSystem's normal equations, with the chain of knots eliminated first or the
/// tags, whichever is less work.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/joint/joint_system.h"

namespace tagfield {

/// How much the unknowns are to change.
struct Move {
  Eigen::VectorXd u;
  std::vector<Eigen::VectorXd> of_tag;
};

/// The step of Gauss and Newton's method, the tags' unknowns damped as Levenberg's.
Move damped_move(const JointSystem& system, double damping, int threads);

/// The inverse of the normal equations' matrix where the system stands, of the tags' places.
JointCovariance inverse_of_normal(const JointSystem& system, int threads);

/// ln of that matrix' determinant.
double log_determinant_of_normal(const JointSystem& system, int threads);

}  // namespace tagfield
