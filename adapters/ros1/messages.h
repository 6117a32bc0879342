// SPDX-License-Identifier: Apache-2.0
/// @file
/// Positions, rotations and poses as ROS messages.
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/TransformStamped.h>

#include <string>

#include "adapters/ros1/ros_link.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

inline geometry_msgs::Point point_message(const Eigen::Vector3d& p) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = p.z();
  return message;
}

inline geometry_msgs::Vector3 vector_message(const Eigen::Vector3d& v) {
  geometry_msgs::Vector3 message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

inline geometry_msgs::Quaternion rotation_message(const Eigen::Quaterniond& q) {
  geometry_msgs::Quaternion message;
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  message.w = q.w();
  return message;
}

inline geometry_msgs::Pose pose_message(const RigidTransform& X) {
  geometry_msgs::Pose message;
  message.position = point_message(X.translation);
  message.orientation = rotation_message(X.rotation);
  return message;
}

/// The pose of frame `child` in frame `parent`.
inline geometry_msgs::TransformStamped frame_message(Time stamp, const std::string& parent,
                                                     const std::string& child,
                                                     const RigidTransform& X) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = to_ros(stamp);
  message.header.frame_id = parent;
  message.child_frame_id = child;
  message.transform.translation = vector_message(X.translation);
  message.transform.rotation = rotation_message(X.rotation);
  return message;
}

}  // namespace tagfield
