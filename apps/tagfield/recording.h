// SPDX-License-Identifier: Apache-2.0
/// @file
/// What is to be localized, wherever it comes from.
#pragma once

#include <string>
#include <vector>

#include "apps/tagfield/localize.h"
#include "tagfield/base/error.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

/// Antenna poses and what they are: "true", "odometry", "tf", "given".
struct NamedPoses {
  std::string name;
  std::vector<AntennaPose> poses;
};

struct RecordingToLocalize {
  std::vector<TagRead> reads;
  NamedPoses poses;
  NamedPoses other;  ///< To be compared with; empty where there are none.
  Truth truth;       ///< Empty where unknown.
  double path_length_m = 0.0;
  double duration_s = 0.0;  ///< 0 where unknown.
};

/// Reads and poses as CSV. Throws Error where `--poses` is missing.
RecordingToLocalize csv_recording(const LocalizeArguments& arguments);

/// A rosbag, with a progress bar. Throws Error where it has not the poses that were asked for.
RecordingToLocalize bag_recording(const LocalizeArguments& arguments, Diagnostics& diagnostics);

}  // namespace tagfield
