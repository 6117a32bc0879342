// SPDX-License-Identifier: Apache-2.0
/// @file
/// The result of a seed's run as a line of JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/experiment/experiment.h"

namespace tagfield {

/// The run of one seed, and its warnings.
struct KeptSeed {
  SeedRun run;
  std::vector<std::string> warnings;
};

/// Everything that summarize() needs of runs other than the first. Omits the recording, the
/// covariances of candidates, and the paths and maps of a survey except the map that was navigated
/// with.
std::string to_json_line(const SeedRun& run, const std::vector<std::string>& warnings);

/// Inverse. Throws Error, which begins with `location`, on text that is not such a line.
KeptSeed kept_seed_in(std::string_view json, const Location& location);

}  // namespace tagfield
