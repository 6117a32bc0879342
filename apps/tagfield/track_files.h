// SPDX-License-Identifier: Apache-2.0
/// @file
/// Output files of `track`, and of `run` for a scenario with moving tags.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "tagfield/experiment/tracking_run.h"
#include "tagfield/files/staged_folder.h"

namespace tagfield {

/// Adds tracks, verdicts and orders as tables, the evaluation as JSON, the map, and the page if
/// `with_page`. `first` is the first of the summary's seeds.
void stage_tracks(const TrackSummary& summary, const TrackingRun& first, bool with_page,
                  StagedFolder& folder);

/// Same, for tracks that TrackTables wrote, with these numbers of tags and reads.
void stage_summary(const TrackSummary& summary, const TrackingRun& first, std::size_t tags,
                   std::size_t reads, bool with_page, StagedFolder& folder);

/// Writes tracks and verdicts part by part.
class TrackTables {
 public:
  explicit TrackTables(StagedFolder& folder);
  void add(const std::vector<TagTrack>& tracks);

 private:
  std::shared_ptr<GrowingFile> tracks_, verdicts_;
};

/// All files that stage_tracks() may have written earlier.
const std::vector<std::filesystem::path>& track_file_names();

}  // namespace tagfield
