// SPDX-License-Identifier: Apache-2.0
/// @file
/// A comparison as a table of text.
#pragma once

#include <string>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/bench_files.h"

namespace tagfield {

/// A block for each condition with a line for each method. Errors in mm.
std::string bench_to_text(const Bench& bench, Timing timing);

}  // namespace tagfield
