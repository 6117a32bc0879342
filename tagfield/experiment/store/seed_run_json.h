// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a seed's run came to, as a line of JSON.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/experiment/experiment.h"

namespace tagfield {

/// One seed, and what there was to warn of.
struct KeptSeed {
  SeedRun run;
  std::vector<std::string> warnings;
};

/// All that summarize() asks of another run than the first: not the recording, of candidates no
/// covariance, of a survey no ways and no map but the one that was driven by.
std::string to_json_line(const SeedRun& run, const std::vector<std::string>& warnings);

/// Inverse. Throws Error, which begins with `location`, on text that is no such line.
KeptSeed kept_seed_in(std::string_view json, const Location& location);

}  // namespace tagfield
