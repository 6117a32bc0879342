// SPDX-License-Identifier: Apache-2.0
/// @file
/// One pass over a recording of ROS 2.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adapters/ros1/bag_content.h"
#include "adapters/rosbag2/recorded_file.h"
#include "tagfield/base/error.h"

namespace tagfield {

/// The files of a recording of ROS 2; few of them stay open, since to open one may take as long as
/// to read it.
class Ros2Files {
 public:
  /// An MCAP file, a database of rosbag2, or a folder of them. Throws Error where there are none.
  Ros2Files(const std::string& path, Diagnostics& diagnostics);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::size_t size() const { return files_.size(); }
  /// Throws Error where the file is broken, or this program was built without its kind.
  std::shared_ptr<RecordedFile> open(std::size_t index, Diagnostics& diagnostics);
  [[nodiscard]] const std::string& path(std::size_t index) const { return files_[index]; }

 private:
  std::string path_;
  std::vector<std::string> files_;
  std::vector<std::shared_ptr<RecordedFile>> open_;
};

/// As sweep_bag(), by the types of ROS 2: tagfield_msgs' TagReads, AntennaTruth and TagPositions,
/// tf2_msgs' TFMessage, nav_msgs' Odometry.
BagContent sweep_ros2(Ros2Files& files, const BagReadSink& sink,
                      const std::function<void(double share)>& on_progress,
                      Diagnostics& diagnostics);

}  // namespace tagfield
