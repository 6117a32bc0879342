// SPDX-License-Identifier: Apache-2.0
/// @file
/// A node's private parameters. A parameter of the wrong type or out of range throws Error, in one
/// line with its name.
#pragma once

#include <ros/ros.h>

#include <string>

#include "adapters/ros1/navigation/frame_listener.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

class NodeParameters {
 public:
  explicit NodeParameters(ros::NodeHandle private_node) : node_(std::move(private_node)) {}

  [[nodiscard]] std::string text(const std::string& name, const std::string& fallback) const;
  [[nodiscard]] bool flag(const std::string& name, bool fallback) const;
  /// Finite.
  [[nodiscard]] double number(const std::string& name, double fallback) const;
  /// Finite and > 0.
  [[nodiscard]] double positive(const std::string& name, double fallback) const;
  /// 1 or more.
  [[nodiscard]] int count(const std::string& name, int fallback) const;
  /// `initial_pose_x`, `…_y`, `…_a` [m, rad]; default 0.
  [[nodiscard]] PlanarPose initial_pose() const;

 private:
  ros::NodeHandle node_;
};

/// Runs `make()`, which creates the node, and then the node until it is asked to exit. An exception
/// causes one line and exit code 2.
template <class Make>
int run_node(Make make) {
  try {
    const auto node = make();
    ros::spin();
    return 0;
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
}

}  // namespace tagfield
