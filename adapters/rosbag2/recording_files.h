// SPDX-License-Identifier: Apache-2.0
/// @file
/// The files of a ROS 2 recording.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adapters/rosbag2/recorded_file.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// Whether a path is meant to be a ROS 2 recording: an MCAP file or a database, judging by its name
/// (….mcap, ….db3) or its first bytes, or a folder with a metadata.yaml or such files.
bool is_ros2_recording(const std::string& path);

/// The command that decompresses a recording of ROS 1 or 2 that is compressed as a whole, judging
/// by its name (….bag.gz, ….db3.zstd): "zstd -d"; "" for other files.
std::string decompressor_of(const std::string& path);

/// The file itself; or those of a folder, in the order of its metadata.yaml. Without that, as after
/// an interrupted recording, they are in the order of the numbers in their names, with a warning.
/// Throws Error if metadata.yaml can't be read or names files outside of the folder or files
/// compressed as a whole, and if no file is left.
std::vector<std::string> files_of_recording(const std::string& path, Diagnostics& diagnostics);

/// Opens a file of either kind, judging by its name or first bytes. Throws Error as the functions
/// that open either kind.
std::unique_ptr<RecordedFile> open_recorded_file(const std::string& path, Diagnostics& diagnostics);

}  // namespace tagfield
