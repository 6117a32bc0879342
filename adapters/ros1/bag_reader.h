// SPDX-License-Identifier: Apache-2.0
/// @file
/// The one function of the library lib/tagfield/rosbag.so: read_bag() of bag_recording.h, for those
/// that load it.
#pragma once

#include <string>

#include "adapters/ros1/bag_recording.h"

extern "C" {

/// As read_bag(), whose result becomes `recording`.
void tagfield_read_bag(const std::string& path, const tagfield::BagOptions& options,
                       tagfield::Diagnostics& diagnostics, tagfield::BagRecording& recording);
}
