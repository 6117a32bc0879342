// SPDX-License-Identifier: Apache-2.0
/// @file
/// Times, positions and poses as ROS 2 messages.
#pragma once

#include <string>

#include "adapters/ros2/ros2_messages.h"
#include "tagfield/base/time.h"
#include "tagfield/motion/robot_reports.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield::ros2 {

/// Seconds are rounded down, so that nanoseconds are never negative.
builtin_interfaces::Time to_message(Time stamp);
geometry_msgs::Point point_message(const Eigen::Vector3d& p);
geometry_msgs::Vector3 vector_message(const Eigen::Vector3d& v);
geometry_msgs::Pose pose_message(const RigidTransform& X);
std_msgs::Header header_message(Time stamp, const std::string& frame);
/// The pose of frame `child` in frame `parent`.
geometry_msgs::TransformStamped frame_message(Time stamp, const std::string& parent,
                                              const std::string& child, const RigidTransform& X);
/// Odometry measures x, y and yaw; the covariance gives the rest a small variance, as a robot stays
/// on its floor.
nav_msgs::Odometry odometry_message(const OdometryReport& report, const RobotNames& names);

}  // namespace tagfield::ros2
