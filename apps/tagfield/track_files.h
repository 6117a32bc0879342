// SPDX-License-Identifier: Apache-2.0
/// @file
/// What `track` writes, and `run` of a scenario that says where its tags run.
#pragma once

#include <filesystem>
#include <vector>

#include "tagfield/experiment/tracking_run.h"
#include "tagfield/files/staged_folder.h"

namespace tagfield {

/// Adds tracks, verdicts and orders as tables, the judgement as JSON, the map, and the page if
/// `with_page`. `first` is the first seed of those in the summary.
void stage_tracks(const TrackSummary& summary, const TrackingRun& first, bool with_page,
                  StagedFolder& folder);

/// All that stage_tracks() may have written earlier.
const std::vector<std::filesystem::path>& track_file_names();

}  // namespace tagfield
