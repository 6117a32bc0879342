// SPDX-License-Identifier: Apache-2.0
/// @file
/// One pass over a ROS 2 recording.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adapters/bags/bag_content.h"
#include "adapters/rosbag2/recorded_file.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// The files of a ROS 2 recording; only a few stay open, since opening one may take as long as
/// reading it.
class Ros2Files {
 public:
  /// An MCAP file, a rosbag2 database, or a folder of them. Throws Error if there are none.
  Ros2Files(const std::string& path, Diagnostics& diagnostics);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::size_t size() const { return files_.size(); }
  /// Throws Error if the file is corrupt, or this program was built without support for its kind.
  std::shared_ptr<RecordedFile> open(std::size_t index, Diagnostics& diagnostics);
  [[nodiscard]] const std::string& path(std::size_t index) const { return files_[index]; }

 private:
  std::string path_;
  std::vector<std::string> files_;
  std::vector<std::shared_ptr<RecordedFile>> open_;
};

/// As sweep_bag(), with the message types of ROS 2: tagfield_msgs' TagReads, AntennaTruth and
/// TagPositions, tf2_msgs' TFMessage, nav_msgs' Odometry.
BagContent sweep_ros2(Ros2Files& files, const BagReadSink& sink,
                      const std::function<void(double share)>& on_progress,
                      Diagnostics& diagnostics);

}  // namespace tagfield
