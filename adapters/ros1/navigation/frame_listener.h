// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a node hears of frames (tf), and what it tells of them.
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

/// The names that a robot's frames have (REP-105).
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

  /// X_FB of frame B in frame F at `stamp`, or none where tf can't tell.
  [[nodiscard]] std::optional<RigidTransform> find(const std::string& F, const std::string& B,
                                                   Time stamp) const;
  /// The newest.
  [[nodiscard]] std::optional<RigidTransform> newest(const std::string& F,
                                                     const std::string& B) const;
  /// The time of the newest, or none; the epoch for one that never changes.
  [[nodiscard]] std::optional<Time> newest_stamp(const std::string& F, const std::string& B) const;
  /// Why there is no newest X_FB, in words.
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

/// Tells where the odometry's frame is on the map, on `tf`.
class MapFrameTeller {
 public:
  MapFrameTeller(ros::NodeHandle& node, FrameNames names);
  /// Of the robot's poses on the map and by odometry at the same moment.
  void tell(const PlanarPose& pose_M, const PlanarPose& odometry, Time stamp);

 private:
  FrameNames names_;
  ros::Publisher publisher_;
};

/// Notices that time went back.
class TimeWatch {
 public:
  /// Whether time is before what it was at the last call.
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
