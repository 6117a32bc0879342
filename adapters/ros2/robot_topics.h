// SPDX-License-Identifier: Apache-2.0
/// @file
/// A Gazebo robot's topics as ROS 2 messages.
#pragma once

#include <memory>
#include <optional>

#include "adapters/ros2/message_sink.h"
#include "tagfield/motion/robot_reports.h"

namespace tagfield::ros2 {

/// odom, ground_truth/odom and scan in the robot's namespace, /tf and /tf_static; names and
/// meanings as in ROS 1, except that Gazebo's world frame is named map.
class RobotTopics {
 public:
  RobotTopics(std::shared_ptr<MessageSink> sink, RobotNames names);

  void publish(const OdometryReport& odometry) const;
  void publish(const MotionReport& motion) const;
  void publish(const ScanReport& scan) const;
  /// Publishes the laser's frame on the base, if there is one, and the odometry frame in its
  /// parent.
  void publish_fixed_frames(Time now, const std::optional<RigidTransform>& X_BL,
                            const RigidTransform& X_WO) const;

 private:
  std::shared_ptr<MessageSink> sink_;
  RobotNames names_;
  Publisher<nav_msgs::Odometry> odometry_;
  Publisher<nav_msgs::Odometry> truth_;
  Publisher<sensor_msgs::LaserScan> scans_;
  Publisher<tf2_msgs::TFMessage> tf_;
  Publisher<tf2_msgs::TFMessage> static_tf_;
};

}  // namespace tagfield::ros2
