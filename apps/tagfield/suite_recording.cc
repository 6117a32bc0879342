// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/suite_recording.h"

#include <utility>

#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/odd_tables.h"

namespace tagfield {

RecordedReads read_recording(const SuiteRecording& recording, Diagnostics& diagnostics) {
  ReadsAndPoses tables =
      read_tables({"recording", recording.reads, recording.poses, recording.format}, diagnostics);
  warn_of_odd_reads(recording.reads, overview_of(tables.reads), diagnostics);
  warn_of_odd_poses(recording.poses.empty() ? recording.reads : recording.poses, tables.poses,
                    diagnostics);
  return {std::move(tables.reads), std::move(tables.poses)};
}

}  // namespace tagfield
