// SPDX-License-Identifier: Apache-2.0
/// @file
/// Probabilistic error model of wheel odometry with the usual four parameters.
#pragma once

#include <Eigen/Core>

#include "tagfield/base/random.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// α1 to α4 of Thrun, Burgard, Fox, Probabilistic Robotics (2005), section 5.4, as in gmapping and
/// amcl. Differences: there the standard deviation grows in proportion to the distance, so that it
/// depends on how finely a motion is divided; here the variance does, and each parameter is the
/// standard deviation after one unit. There the rotations before and after the translation have
/// independent errors; here they are correlated, as the heading drifts along the whole path. The
/// path is assumed to be an arc, so its rotation is the change of heading. Defaults suit a P3-AT: 1
/// cm and 0.5° after 1 m, 3° after a full turn.
struct OdometryNoise {
  double alpha1 = 0.02;   ///< Error of the heading due to turning [rad/√rad].
  double alpha2 = 0.009;  ///< Error of the heading due to driving [rad/√m].
  double alpha3 = 0.01;   ///< Error of the distance due to driving [m/√m].
  double alpha4 = 0.002;  ///< Error of the distance due to turning [m/√rad].
};

/// Throws Error on a parameter that is negative or not finite.
void check(const OdometryNoise& noise);

/// The noisy odometry of the true motion `increment` from one pose to the next, in the axes of the
/// first, from two pairs of draws of the stream. With s the length of the chord and Δ the change of
/// heading:
///
///     p' = R(n₁)(p + n_s u),  yaw' = yaw + n₁ + n₂,  u along the middle heading Δ/2
///     var(n₁ + n₂) = α1²|Δ| + α2² s =: v,  var n₁ = var n₂ = v/3,  cov(n₁, n₂) = v/6
///     var n_s = α3² s + α4²|Δ|
///
/// On a straight path the distribution is the same, to first order, however the path is divided: if
/// the heading error is a random walk of variance v over the distance s, the lateral error has
/// variance v s²/3 and covariance v s/2 with the final heading.
PlanarPose noisy_increment(const PlanarPose& increment, const OdometryNoise& noise,
                           RandomStream& stream);

/// Covariance of x, y [m], yaw [rad] of noisy_increment(), to first order, in the axes of the first
/// pose. Singular: rank 2 for a turn on the spot.
Eigen::Matrix3d increment_covariance(const PlanarPose& increment, const OdometryNoise& noise);

/// Covariance of x, y [m], yaw [rad] of the pose reached by `increment` from `q_OB`, to first
/// order, given the `covariance` of q_OB. Both in the axes of O.
Eigen::Matrix3d propagated_covariance(const Eigen::Matrix3d& covariance, const PlanarPose& q_OB,
                                      const PlanarPose& increment, const OdometryNoise& noise);

/// Variances of an increment's length [m²] and of its change of heading [rad²].
Eigen::Vector2d increment_variances(const PlanarPose& increment, const OdometryNoise& noise);

}  // namespace tagfield
