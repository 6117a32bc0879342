// SPDX-License-Identifier: Apache-2.0
/// @file
/// ROS 2 messages written to an MCAP file, as rosbag2 would record them.
#pragma once

#include <memory>
#include <string>

#include "adapters/ros2/message_sink.h"

namespace tagfield::ros2 {

/// Stamps are used as both log and publish times. The file appears on finish(); an interrupted run
/// leaves PATH.PID.partial. Throws Error if the file can't be written, or if this program was built
/// without MCAP.
std::shared_ptr<MessageSink> mcap_file(const std::string& path);

}  // namespace tagfield::ros2
