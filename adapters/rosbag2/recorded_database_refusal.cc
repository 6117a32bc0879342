// SPDX-License-Identifier: Apache-2.0
// Replaces recorded_database.cc in builds without SQLite.
#include "adapters/rosbag2/recorded_file.h"

namespace tagfield {

std::unique_ptr<RecordedFile> open_recorded_database(const std::string& path,
                                                     Diagnostics& /*diagnostics*/) {
  fail({path, 0},
       "is a database, and this tagfield was built without SQLite; build it again after "
       "'scripts/setup --ros'");
}

}  // namespace tagfield
