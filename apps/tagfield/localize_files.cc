// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/localize_files.h"

#include <filesystem>

#include "adapters/bags/bag_recording.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/top_view_file.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/files/files.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/tag_heights_csv.h"
#include "tagfield/files/tag_positions_csv.h"
#include "tagfield/files/truth_csv.h"
#include "tagfield/report/estimates_csv.h"

namespace tagfield {

bool is_empty(const Truth& truth) {
  return truth.antenna_poses.empty() && truth.robot_poses.empty() && truth.tag_positions.empty() &&
         truth.distances.empty();
}

namespace {

/// Stages reads, and the truth with its distances, that are not held in memory.
void stage_unreported(const UnreportedReads& unreported, const Truth& truth, StagedFolder& folder) {
  const bool has_doppler = unreported.overview.has_doppler;
  const bool has_truth = unreported.has_distances || !is_empty(truth);
  if (has_truth) stage_true_positions(truth, folder);
  ProgressBar bar("writing reads");
  BagReads rows;
  rows.on_progress = [&bar](double share) { bar.show(share); };
  folder.add_written("reads.csv", [&](GrowingFile& reads) {
    reads.text() += reads_header(has_doppler);
    rows.on_read = [&](const TagRead& read) {
      append_row(read, has_doppler, reads.text());
      reads.sync();
    };
    if (!has_truth) return unreported.tell(rows);
    folder.add_written(kDistancesFile, [&](GrowingFile& distances) {
      distances.text() += kDistancesHeader;
      rows.on_distance = [&](const TrueDistance& distance) {
        append_row(distance, distances.text());
        distances.sync();
      };
      unreported.tell(rows);
    });
  });
}

}  // namespace

void stage_localization(const LoadedRecording& recording,
                        const std::optional<ScenarioWithWorld>& loaded,
                        const LocalizationOptions& options, const LocalizationResult& result,
                        const OdometryByAntenna& odometry, StagedFolder& folder) {
  if (!recording.table.empty()) {
    folder.add_copy("reads.csv", recording.table);
  } else if (!recording.unreported) {
    folder.add("reads.csv", reads_to_csv(recording.reads));
  }
  folder.add("antenna_poses.csv", poses_to_csv(recording.poses.poses));
  if (!recording.other.poses.empty()) {
    folder.add("compared_poses.csv", poses_to_csv(recording.other.poses));
  }
  folder.add("estimates.csv", estimates_to_csv(result.estimates));
  if (!result.corrected_poses.empty()) {
    folder.add("corrected_poses.csv", poses_to_csv(result.corrected_poses));
  }
  if (!options.known.reference_tags.empty()) {
    folder.add("reference_tags.csv", tag_positions_to_csv(options.known.reference_tags));
  }
  if (recording.unreported) {
    stage_unreported(*recording.unreported, recording.truth, folder);
  } else if (!recording.true_distances.empty() && !is_empty(recording.truth)) {
    stage_true_positions(recording.truth, folder);
    folder.add_copy(kDistancesFile, recording.true_distances);
  } else if (!is_empty(recording.truth)) {
    stage_truth(recording.truth, folder);
  }
  if (!odometry.empty()) folder.add("odometry.csv", odometry_to_csv(odometry));
  if (!options.known.heights.of_tag.empty()) {
    folder.add("tag_heights.csv", tag_heights_to_csv(options.known.heights.of_tag));
  }
  if (loaded) stage_top_view(*loaded, folder);
}

void keep_of_this_run(const std::string& out, StagedFolder& folder) {
  for (const char* name : {"top_view.json", "tag_heights.csv", "odometry.csv"}) {
    const std::filesystem::path file = std::filesystem::path(out) / name;
    if (is_there(file) && !is_there(folder.staging() / name)) {
      folder.add(name, read_text_file(file.string()));
    }
  }
}

}  // namespace tagfield
