// SPDX-License-Identifier: Apache-2.0
/// @file
/// Of which files a recording of ROS 2 consists.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adapters/rosbag2/recorded_file.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// Whether a path is meant to be one: an MCAP file or a database, by its name (….mcap, ….db3) or
/// how it begins, or a folder with a metadata.yaml or such files.
bool is_ros2_recording(const std::string& path);

/// The file itself; or those of a folder, in the order of its metadata.yaml. Without that, as after
/// a recording that was cut off, in the order of the numbers in their names, with a warning. Throws
/// Error on a metadata.yaml that can't be read, or names files outside of the folder or compressed
/// as a whole, and where no file is left.
std::vector<std::string> files_of_recording(const std::string& path, Diagnostics& diagnostics);

/// By its name or how it begins. Throws Error as the functions that open either kind.
std::unique_ptr<RecordedFile> open_recorded_file(const std::string& path, Diagnostics& diagnostics);

}  // namespace tagfield
