// SPDX-License-Identifier: Apache-2.0
/// @file
/// Solution of a JointSystem's normal equations, eliminating either the chain of knots or the tags
/// first, whichever is less work.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/joint/joint_system.h"

namespace tagfield {

/// Step of the unknowns.
struct Move {
  Eigen::VectorXd u;
  std::vector<Eigen::VectorXd> of_tag;
};

/// Gauss-Newton step with Levenberg's damping of the tags' unknowns.
Move damped_move(const JointSystem& system, double damping, int threads);

/// Inverse of the normal equations' matrix at the current state, for the tags' positions.
JointCovariance inverse_of_normal(const JointSystem& system, int threads);

/// ln of the determinant of that matrix.
double log_determinant_of_normal(const JointSystem& system, int threads);

}  // namespace tagfield
