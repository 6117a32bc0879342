// SPDX-License-Identifier: Apache-2.0
// Replaces recorded_mcap.cc in builds without MCAP.
#include "adapters/rosbag2/recorded_file.h"

namespace tagfield {

std::unique_ptr<RecordedFile> open_recorded_mcap(const std::string& path,
                                                 Diagnostics& /*diagnostics*/) {
  fail({path, 0},
       "is MCAP, and this tagfield was built without it; build it again after "
       "'scripts/setup --ros'");
}

}  // namespace tagfield
