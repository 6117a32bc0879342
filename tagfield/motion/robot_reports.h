// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a simulated robot publishes about itself, whatever the middleware.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// Names of a robot's topics and frames.
struct RobotNames {
  std::string name_space;
  std::string base = "base_link";
  std::string odom = "odom";
  std::string laser = "laser";
  std::string odom_parent;  ///< "" for none.
  bool publish_tf = true;
};

/// Wheel odometry at one time.
struct OdometryReport {
  Time stamp;
  PlanarPose pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of x, y, yaw.
  BodyVelocity velocity;
  Eigen::Vector2d velocity_variance = Eigen::Vector2d::Zero();  ///< Of forward and turn.
};

/// True motion at one time.
struct MotionReport {
  Time stamp;
  RigidTransform X_WB;
  Eigen::Vector3d linear_B = Eigen::Vector3d::Zero();   ///< [m/s], in the base's axes.
  Eigen::Vector3d angular_B = Eigen::Vector3d::Zero();  ///< [rad/s], in the base's axes.
};

/// One reading of a laser scanner.
struct ScanReport {
  Time stamp;
  double first_angle_rad = 0.0;
  double last_angle_rad = 0.0;
  double interval_s = 0.0;  ///< To the next reading.
  double min_range_m = 0.0;
  double max_range_m = 0.0;
  std::vector<float> ranges_m;
};

}  // namespace tagfield
