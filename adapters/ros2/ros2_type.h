// SPDX-License-Identifier: Apache-2.0
/// @file
/// Description of a message type for ROS 2 and its bags.
#pragma once

#include <string>

namespace tagfield::ros2 {

struct Ros2Type {
  std::string name;        ///< "tagfield_msgs/msg/TagReads"
  std::string hash;        ///< "RIHS01_…", which versions from Iron on compare.
  std::string definition;  ///< The .msg file and those of all nested types ("ros2msg").
  std::string (*to_cdr)(const void* message);
};

}  // namespace tagfield::ros2
