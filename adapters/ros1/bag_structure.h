// SPDX-License-Identifier: Apache-2.0
/// @file
/// Validation of a bag file's records before rosbag reads it: rosbag follows the offsets of a
/// damaged index wherever they lead, even outside its memory.
#pragma once

#include <string>

namespace tagfield {

/// Throws Error unless the file is a finished bag of version 2.0, all its records lie within it,
/// and its index points at messages.
void require_whole_bag(const std::string& path);

}  // namespace tagfield
