// SPDX-License-Identifier: Apache-2.0
/// @file
/// How well tags can be located at best: the Cramér-Rao bound, of each tag by itself and of all
/// together, with the pose error as a random process (the Bayesian bound).
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// What a bound is computed on.
struct BoundInput {
  /// Samples with the antennas' true places, and what is known beforehand. Of each tag and antenna
  /// one phase offset a channel is unknown unless `offset_known` has the antenna.
  LocalizationProblem truth;
  std::map<std::string, Eigen::Vector3d> places;  ///< True places of the tags [m, world].
  std::map<std::string, double> phase_noise_rad;  ///< Standard deviation, by antenna; over 0.
};

/// Covariances that no unbiased estimator can undercut.
struct Bounds {
  std::vector<std::string> tags;  ///< Those that can be bounded, in rising order.
  /// Covariance of all places, 3 rows a tag [m²]; rows of a height that is known are 0. Of single
  /// bounds the blocks off the diagonal are 0.
  Eigen::MatrixXd covariance;
};

/// Each tag by itself: from its own reads only, with its own share of the pose error to bear.
Bounds single_bounds(const BoundInput& input);

/// All tags and the pose error together.
Bounds joint_bounds(const BoundInput& input);

/// Covariance of the i-th tag of `bounds`.
Eigen::Matrix3d covariance_of(const Bounds& bounds, std::size_t i);

/// Mean length [m] of a horizontal error with this covariance: √(2λ₁/π) E(1 − λ₂/λ₁) with the
/// eigenvalues λ₁ ≥ λ₂ and the complete elliptic integral E of the second kind, by parameter.
double mean_horizontal_error(const Eigen::Matrix3d& covariance);

}  // namespace tagfield
