// SPDX-License-Identifier: Apache-2.0
/// @file
/// A node's input and output of frames (tf).
#pragma once

#include <ros/ros.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <optional>
#include <string>

#include "tagfield/base/time.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// The names of a robot's frames (REP-105).
struct FrameNames {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";
};

/// Fills a tf2 buffer from `tf` and `tf_static` on the callback queue of its node handle, so that
/// nothing changes while a callback of the node runs.
class FrameListener {
 public:
  /// Calls `on_change` after each message.
  FrameListener(ros::NodeHandle& node, std::function<void()> on_change);

  /// X_FB of frame B in frame F at `stamp`, or none if unknown to tf.
  [[nodiscard]] std::optional<RigidTransform> find(const std::string& F, const std::string& B,
                                                   Time stamp) const;
  /// The newest X_FB.
  [[nodiscard]] std::optional<RigidTransform> newest(const std::string& F,
                                                     const std::string& B) const;
  /// The stamp of the newest X_FB, if any; the epoch if it never changes.
  [[nodiscard]] std::optional<Time> newest_stamp(const std::string& F, const std::string& B) const;
  /// Why there is no newest X_FB, as text.
  [[nodiscard]] std::string trouble(const std::string& F, const std::string& B) const;
  /// Forgets all that changes with time.
  void forget() { buffer_.clear(); }

 private:
  void take(const tf2_msgs::TFMessage& message, bool is_static);

  tf2::BufferCore buffer_;
  std::function<void()> on_change_;
  ros::Subscriber changing_;
  ros::Subscriber fixed_;
};

/// Publishes the pose of the odometry frame in the map on `tf`.
class MapFrameTeller {
 public:
  MapFrameTeller(ros::NodeHandle& node, FrameNames names);
  /// Computes it from the robot's poses on the map and by odometry at the same time.
  void tell(const PlanarPose& pose_M, const PlanarPose& odometry, Time stamp);

 private:
  FrameNames names_;
  ros::Publisher publisher_;
};

/// Detects that time went back.
class TimeWatch {
 public:
  /// Whether the time is earlier than at the last call.
  bool went_back() {
    const ros::Time now = ros::Time::now();
    const bool back = now < last_;
    last_ = now;
    return back;
  }

 private:
  ros::Time last_;
};

}  // namespace tagfield
