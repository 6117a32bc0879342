// SPDX-License-Identifier: Apache-2.0
/// @file
/// The records of a bag file, looked through before rosbag reads it: rosbag follows the offsets of
/// a damaged index wherever they lead, out of its memory too.
#pragma once

#include <string>

namespace tagfield {

/// Throws Error unless the file is a bag of version 2.0 that was finished, whose records all lie
/// within it, and whose index points at messages.
void require_whole_bag(const std::string& path);

}  // namespace tagfield
