// SPDX-License-Identifier: Apache-2.0
/// @file
/// Validation of a bag file's records before rosbag reads it: rosbag follows the offsets of a
/// damaged index wherever they lead, even outside its memory.
#pragma once

#include <string>

#include "tagfield/base/error.h"

namespace tagfield {

/// Warns of messages received at time 0, which rosbag leaves out. Throws Error unless the file is a
/// finished bag of version 2.0, all its records lie within it, and its index points at messages.
void require_whole_bag(const std::string& path, Diagnostics& diagnostics);

}  // namespace tagfield
