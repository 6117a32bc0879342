/// @file
/// The error of wheel odometry as a probability: the usual four parameters.
#pragma once

#include <Eigen/Core>

#include "tagfield/base/random.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// α1 to α4 of Thrun, Burgard, Fox, Probabilistic Robotics (2005), section 5.4, as gmapping and amcl
/// have them. A motion is a turn, a straight way and another turn. Departure: there a standard
/// deviation grows as the way, so that it depends on how finely a motion is cut; here it grows as the
/// way's root, and each parameter is the standard deviation after one unit. Defaults suit a P3-AT.
struct OdometryNoise {
  double alpha1 = 0.02;   ///< Of the heading by turning [rad/√rad].
  double alpha2 = 0.009;  ///< Of the heading by driving [rad/√m].
  double alpha3 = 0.01;   ///< Of the way by driving [m/√m].
  double alpha4 = 0.002;  ///< Of the way by turning [m/√rad].
};

/// Throws Error on a parameter that is negative or not finite.
void check(const OdometryNoise& noise);

/// What wheels would tell of the true motion `increment` from one pose to the next, in the axes of
/// the first, by two draws of the stream.
PlanarPose noisy_increment(const PlanarPose& increment, const OdometryNoise& noise,
                           RandomStream& stream);

/// Covariance of x, y, yaw of noisy_increment(), to first order, in the axes of the first pose.
Eigen::Matrix3d increment_covariance(const PlanarPose& increment, const OdometryNoise& noise);

}  // namespace tagfield
