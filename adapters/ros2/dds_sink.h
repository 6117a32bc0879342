// SPDX-License-Identifier: Apache-2.0
/// @file
/// ROS 2 messages sent through DDS like those of a ROS 2 node, without depending on ROS 2.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "adapters/ros2/message_sink.h"

namespace tagfield::ros2 {

/// Whether Tagfield was built with DDS.
extern const bool kHasDds;

/// A node in the graph of a ROS 2 domain.
class DdsSink : public MessageSink {
 public:
  /// Joins the domain, 0 to 232. Throws Error on failure, such as without a usable network
  /// interface (CYCLONEDDS_URI selects one; docs/ros2.md).
  DdsSink(std::uint32_t domain, const std::string& node_name);
  ~DdsSink() override;

  std::size_t advertise(const Ros2Topic& topic, const Ros2Type& type) override;
  void publish(std::size_t topic, Time stamp, const void* message) override;
  /// Waits until reliable readers have received everything, a few seconds at most.
  void finish() override;

  /// Subscribes to velocities on a topic ("/cmd_vel"), as a Twist or a TwistStamped, whichever is
  /// published: Nav2's are stamped from Kilted on. Returns the subscription's number.
  std::size_t subscribe_twist(const std::string& topic);
  /// The newest one received since the last call.
  std::optional<geometry_msgs::Twist> take_twist(std::size_t subscription);

  /// Waits until there is a reader of any of the topics, for `most` at the longest; returns whether
  /// there is one.
  bool wait_for_reader(Duration most) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield::ros2
