// SPDX-License-Identifier: Apache-2.0
/// @file
/// ROS 2 message types for Cyclone DDS.
#pragma once

#include <dds/dds.h>

#include <functional>
#include <map>
#include <string>

namespace tagfield::ros2 {

struct DdsType {
  const dds_topic_descriptor_t* descriptor = nullptr;
  /// Passes one of our messages to `use` as the struct that the descriptor describes.
  void (*with_struct)(const void* message, const std::function<void(const void*)>& use) = nullptr;
};

/// By name ("tagfield_msgs/msg/TagReads").
const std::map<std::string, DdsType>& dds_types();

}  // namespace tagfield::ros2
