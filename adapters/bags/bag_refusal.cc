// SPDX-License-Identifier: Apache-2.0
// Replaces bag_structure.cc and bag_sweep.cc in builds without ROS 1.
#include "adapters/bags/bag_structure.h"
#include "adapters/bags/bag_sweep.h"

namespace tagfield {

void require_whole_bag(const std::string& path, Diagnostics& /*diagnostics*/) {
  fail({path, 0},
       "this tagfield was built without ROS 1 and cannot read bags; build it again after "
       "'scripts/setup --ros' (TAGFIELD_ROS1)");
}

BagContent sweep_bag(const std::string& path, std::optional<double> /*frequency_hz*/,
                     const BagReadSink& sink, const std::function<void(double)>& /*on_progress*/,
                     Diagnostics& diagnostics) {
  require_whole_bag(path, diagnostics);
  return BagContent(sink);
}

}  // namespace tagfield
