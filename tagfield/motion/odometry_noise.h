// SPDX-License-Identifier: Apache-2.0
/// @file
/// The error of wheel odometry as a probability: the usual four parameters.
#pragma once

#include <Eigen/Core>

#include "tagfield/base/random.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// α1 to α4 of Thrun, Burgard, Fox, Probabilistic Robotics (2005), section 5.4, as gmapping and
/// amcl have them. Departures: there a standard deviation grows as the way, so that it depends on
/// how finely a motion is cut; here a variance does, and each parameter is the standard deviation
/// after one unit. There the turns before and after the way err independently; here together, as
/// the heading errs all along the way. The way is taken to be an arc, so its turning is the change
/// of heading. Defaults suit a P3-AT: after 1 m 1 cm and 0.5°, after a full turn 3°.
struct OdometryNoise {
  double alpha1 = 0.02;   ///< Of the heading by turning [rad/√rad].
  double alpha2 = 0.009;  ///< Of the heading by driving [rad/√m].
  double alpha3 = 0.01;   ///< Of the way by driving [m/√m].
  double alpha4 = 0.002;  ///< Of the way by turning [m/√rad].
};

/// Throws Error on a parameter that is negative or not finite.
void check(const OdometryNoise& noise);

/// What wheels would tell of the true motion `increment` from one pose to the next, in the axes of
/// the first, by two pairs of draws of the stream. With s the length of the chord and Δ the change
/// of heading:
///
///     p' = R(n₁)(p + n_s u),  yaw' = yaw + n₁ + n₂,  u along the middle heading Δ/2
///     var(n₁ + n₂) = α1²|Δ| + α2² s =: v,  var n₁ = var n₂ = v/3,  cov(n₁, n₂) = v/6
///     var n_s = α3² s + α4²|Δ|
///
/// On a straight way that is the same distribution, to first order, however the way is cut: if the
/// heading errs by a random walk of variance v over a way s, its error aside has variance v s²/3
/// and covariance v s/2 with the heading at the end.
PlanarPose noisy_increment(const PlanarPose& increment, const OdometryNoise& noise,
                           RandomStream& stream);

/// Covariance of x, y [m], yaw [rad] of noisy_increment(), to first order, in the axes of the first
/// pose. Singular: of rank 2 for a motion on the spot.
Eigen::Matrix3d increment_covariance(const PlanarPose& increment, const OdometryNoise& noise);

/// Covariance of x, y [m], yaw [rad] of the pose that `increment` leads to from `q_OB`, to first
/// order, if that of q_OB is `covariance`. Both in the axes of O.
Eigen::Matrix3d carried_covariance(const Eigen::Matrix3d& covariance, const PlanarPose& q_OB,
                                   const PlanarPose& increment, const OdometryNoise& noise);

/// Variances of an increment's length [m²] and of its change of heading [rad²].
Eigen::Vector2d increment_variances(const PlanarPose& increment, const OdometryNoise& noise);

}  // namespace tagfield
