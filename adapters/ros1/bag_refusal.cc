// SPDX-License-Identifier: Apache-2.0
// Replaces bag_recording.cc in builds without ROS 1.
#include "adapters/ros1/bag_recording.h"

namespace tagfield {

BagRecording read_bag(const std::string& path, const BagOptions& /*options*/,
                      Diagnostics& /*diagnostics*/) {
  fail({path, 0},
       "this tagfield was built without ROS 1 and cannot read bags; build it again after "
       "'scripts/setup --ros' (TAGFIELD_ROS1)");
}

}  // namespace tagfield
