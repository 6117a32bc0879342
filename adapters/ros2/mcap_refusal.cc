// SPDX-License-Identifier: Apache-2.0
// Replaces mcap_file.cc in builds without MCAP.
#include "adapters/ros2/mcap_file.h"
#include "tagfield/base/error.h"

namespace tagfield::ros2 {

std::shared_ptr<MessageSink> mcap_file(const std::string& /*path*/) {
  throw Error("this tagfield was built without MCAP; build it again after 'scripts/setup --ros'");
}

}  // namespace tagfield::ros2
