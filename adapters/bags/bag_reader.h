// SPDX-License-Identifier: Apache-2.0
/// @file
/// The only function of the library lib/tagfield/rosbag.so, which is loaded at run time: read_bag()
/// of bag_recording.h.
#pragma once

#include <string>

#include "adapters/bags/bag_recording.h"

extern "C" {

/// As read_bag(), but stores the result in `recording`.
void tagfield_read_bag(const std::string& path, const tagfield::BagOptions& options,
                       tagfield::Diagnostics& diagnostics, tagfield::BagRecording& recording);
}
