// SPDX-License-Identifier: Apache-2.0
/// @file
/// Keeps ROS's libraries from printing.
#pragma once

#include <console_bridge/console.h>

namespace tagfield {

/// rosbag and tf2 print their complaints; here they come as exceptions or are looked for.
class Silence {
 public:
  Silence() { console_bridge::noOutputHandler(); }
  ~Silence() { console_bridge::restorePreviousOutputHandler(); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
};

}  // namespace tagfield
