// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads that were recorded, and where their tags were.
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

/// The first of the recording's files that is not there.
std::optional<std::string> missing_file(const SuiteRecording& recording);

/// Where the tags were, by ID [m]: of a table with the columns tag, x_m, y_m, and z_m or else at
/// the height `height_m`; or with range_m in place of y_m (of x_m), the distance from the antennas'
/// way towards `side` +y or -y (+x or -x), which must run along the other axis. Only rows of
/// `experiment`, unless that is "". Throws Error "FILE:LINE: …".
std::map<std::string, Eigen::Vector3d> read_tag_truth(const SuiteRecording& recording,
                                                      const std::vector<AntennaPose>& poses,
                                                      double height_m);

/// What localization is told of a recording. Throws Error on a table of heights that can't be read.
KnownBeforehand known_of(const SuiteRecording& recording, const ToldPoseError& believed);

/// Reads, poses, and the places of the tags at rest. Warns of tags that were read and whose places
/// are not known. Throws Error on files that can't be read.
Recording load_recording(const SuiteRecording& recording, const ReadRecording& read,
                         Diagnostics& diagnostics);

}  // namespace tagfield
