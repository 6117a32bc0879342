// SPDX-License-Identifier: Apache-2.0
/// @file
/// The truth of a run as CSV files, in a folder of their own.
#pragma once

#include <string>

#include "tagfield/files/staged_folder.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

inline constexpr const char* kTagsHeader = "stamp_s,tag,x_m,y_m,z_m\n";
inline constexpr const char* kDistancesHeader = "stamp_s,antenna,tag,distance_m\n";

/// Append a line to `text`.
void append_row(const TagPosition& position, std::string& text);
void append_row(const TrueDistance& distance, std::string& text);

inline constexpr const char* kDistancesFile = "truth/distances.csv";

/// Adds truth/antenna_poses.csv, truth/robot_poses.csv and truth/tags.csv
/// (`stamp_s,tag,x_m,y_m,z_m`).
void stage_true_positions(const Truth& truth, StagedFolder& folder);
/// Same, and truth/distances.csv (`stamp_s,antenna,tag,distance_m`).
void stage_truth(const Truth& truth, StagedFolder& folder);

/// Reads the truth from a run's folder, except for distances (no evaluation uses them). Throws
/// Error if a file is missing or malformed.
Truth read_truth(const std::string& run_folder);

}  // namespace tagfield
