// SPDX-License-Identifier: Apache-2.0
/// @file
/// Recorded reads, and the true positions of their tags.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/localization/problem.h"
#include "tagfield/stream/recording.h"

namespace tagfield {

/// The first of the recording's files that does not exist.
std::optional<std::string> missing_file(const SuiteRecording& recording);

/// The tags' positions by ID [m], from a table with the columns tag, x_m, y_m, and z_m or else the
/// height `height_m`. The column y_m (x_m) may be replaced by range_m, the distance from the
/// antennas' path towards `side` +y or -y (+x or -x); the path must then run along the other axis.
/// Only rows of `experiment`, unless that is "". Throws Error "FILE:LINE: …".
std::map<std::string, Eigen::Vector3d> read_tag_truth(const SuiteRecording& recording,
                                                      const std::vector<AntennaPose>& poses,
                                                      double height_m);

/// The prior knowledge for localization from a recording. Throws Error on a table of heights that
/// can't be read.
KnownBeforehand known_of(const SuiteRecording& recording, const StatedPoseError& believed);

/// Loads reads, poses, and the positions of the stationary tags. Warns about tags that were read
/// but whose positions are unknown. Throws Error on files that can't be read.
Recording load_recording(const SuiteRecording& recording, const ReadRecording& read,
                         Diagnostics& diagnostics);

}  // namespace tagfield
