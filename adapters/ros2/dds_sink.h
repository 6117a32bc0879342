// SPDX-License-Identifier: Apache-2.0
/// @file
/// ROS 2 messages into DDS, as a node of ROS 2 would send them, without any of ROS 2.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "adapters/ros2/message_sink.h"

namespace tagfield::ros2 {

/// Whether this was built with DDS.
extern const bool kHasDds;

/// A node in the graph of a ROS 2 domain.
class DdsSink : public MessageSink {
 public:
  /// Joins the domain, 0 to 232. Throws Error if that can't be done, as without a network interface
  /// to use (CYCLONEDDS_URI says which; docs/ros2.md).
  DdsSink(std::uint32_t domain, const std::string& node_name);
  ~DdsSink() override;

  std::size_t advertise(const Ros2Topic& topic, const Ros2Type& type) override;
  void publish(std::size_t topic, Time stamp, const void* message) override;
  /// Waits until reliable readers have got it all, a few seconds at the most.
  void finish() override;

  /// Listens to velocities on a topic ("/cmd_vel"), as a Twist or a TwistStamped, whichever is
  /// published: Nav2's are stamped from Kilted on. Gives its number.
  std::size_t subscribe_twist(const std::string& topic);
  /// The newest that came since this was asked last.
  std::optional<geometry_msgs::Twist> take_twist(std::size_t subscription);

  /// Waits until somebody listens to any of the topics, `most` at the longest; whether one does.
  bool wait_for_reader(Duration most) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield::ros2
