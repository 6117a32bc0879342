/// @file
/// One pass over an MCAP file with messages of ROS 2.
#pragma once

#include <functional>
#include <string>

#include "adapters/ros1/bag_content.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// Whether a file is meant to be MCAP: by its name (….mcap) or how it begins.
bool is_mcap(const std::string& path);

/// As sweep_bag(), by the types of ROS 2: tagfield_msgs' TagReads, AntennaTruth and TagPositions,
/// tf2_msgs' TFMessage, nav_msgs' Odometry. In order of log time. Throws Error as sweep_bag(), and
/// where this program was built without MCAP.
BagContent sweep_mcap(const std::string& path, const std::function<void(double share)>& on_progress,
                      Diagnostics& diagnostics);

}  // namespace tagfield
