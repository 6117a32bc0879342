// SPDX-License-Identifier: Apache-2.0
/// @file
/// One pass over a recording of ROS 2.
#pragma once

#include <functional>
#include <string>

#include "adapters/ros1/bag_content.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// As sweep_bag(), by the types of ROS 2: tagfield_msgs' TagReads, AntennaTruth and TagPositions,
/// tf2_msgs' TFMessage, nav_msgs' Odometry; out of an MCAP file, a database of rosbag2, or a folder
/// of them. Throws Error as sweep_bag(), and where this program was built without their kind.
BagContent sweep_ros2(const std::string& path, const BagReadSink& sink,
                      const std::function<void(double share)>& on_progress,
                      Diagnostics& diagnostics);

}  // namespace tagfield
