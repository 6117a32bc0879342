// SPDX-License-Identifier: Apache-2.0
/// @file
/// Suppression of printing by rosbag.
#pragma once

#include <console_bridge/console.h>

namespace tagfield {

/// rosbag prints its errors; here they are caught as exceptions or checked for.
class Silence {
 public:
  Silence() { console_bridge::noOutputHandler(); }
  ~Silence() { console_bridge::restorePreviousOutputHandler(); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
};

}  // namespace tagfield
