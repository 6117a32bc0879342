// SPDX-License-Identifier: Apache-2.0
/// @file
/// A comparison as files, and as human-readable text; docs/bench.md lists every column. Unknown
/// values are null or empty.
#pragma once

#include <string>

#include "tagfield/experiment/bench/bench.h"

namespace tagfield {

/// Whether times are included: without them the bytes are the same whenever the same suite runs.
enum class Timing { kWithTimes, kWithoutTimes };

/// bench.json: suite, description, complete, conditions, entries with their statistics, warnings.
std::string bench_to_json(const Bench& bench, Timing timing);

/// bench.csv: one row per condition and method.
std::string bench_to_csv(const Bench& bench, Timing timing);

/// tags.csv: one row per condition, method, seed and tag.
std::string bench_tags_to_csv(const Bench& bench);

/// One block per condition with one line per method. Errors in mm.
std::string bench_to_text(const Bench& bench, Timing timing);

}  // namespace tagfield
