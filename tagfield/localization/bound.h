// SPDX-License-Identifier: Apache-2.0
/// @file
/// Best achievable localization accuracy: the Cramér-Rao bound for each tag separately and for all
/// jointly, with the pose error as a random process (the Bayesian bound).
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Input of a bound.
struct BoundInput {
  /// Samples with the antennas' true positions, and the prior knowledge. One phase offset per tag,
  /// antenna and channel is unknown unless the antenna is in `offset_known`.
  LocalizationProblem truth;
  std::map<std::string, Eigen::Vector3d> places;  ///< True positions of the tags [m, world].
  std::map<std::string, double> phase_noise_rad;  ///< Standard deviation by antenna; positive.
};

/// Covariances that no unbiased estimator can undercut.
struct Bounds {
  std::vector<std::string> tags;  ///< Those that can be bounded, in ascending order.
  /// Covariance of all positions, 3 rows per tag [m²]; rows of a known height are 0. For single
  /// bounds the off-diagonal blocks are 0.
  Eigen::MatrixXd covariance;
};

/// Bound of each tag separately: from its own reads only, which must also determine the pose error.
Bounds single_bounds(const BoundInput& input);

/// Joint bound of all tags and the pose error.
Bounds joint_bounds(const BoundInput& input);

/// Covariance of the i-th tag of `bounds`.
Eigen::Matrix3d covariance_of(const Bounds& bounds, std::size_t i);

/// Mean length [m] of a horizontal error with this covariance: √(2λ₁/π) E(1 − λ₂/λ₁) with the
/// eigenvalues λ₁ ≥ λ₂ and the complete elliptic integral of the second kind E(m) of parameter m.
double mean_horizontal_error(const Eigen::Matrix3d& covariance);

}  // namespace tagfield
