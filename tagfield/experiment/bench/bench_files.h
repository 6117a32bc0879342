// SPDX-License-Identifier: Apache-2.0
/// @file
/// A comparison as files, and as text for people; docs/bench.md lists every column. What is unknown
/// is null or empty.
#pragma once

#include <string>

#include "tagfield/experiment/bench/bench.h"

namespace tagfield {

/// Times can be left out: all else is the same bytes whenever the same suite runs.
enum class Timing { kWithTimes, kWithoutTimes };

/// bench.json: suite, description, complete, conditions, entries with their statistics, warnings.
std::string bench_to_json(const Bench& bench, Timing timing);

/// bench.csv: a row for each condition and method.
std::string bench_to_csv(const Bench& bench, Timing timing);

/// tags.csv: a row for each condition, method, seed and tag.
std::string bench_tags_to_csv(const Bench& bench);

/// A block for each condition with a line for each method. Errors in mm.
std::string bench_to_text(const Bench& bench, Timing timing);

}  // namespace tagfield
