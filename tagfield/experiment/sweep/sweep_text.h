// SPDX-License-Identifier: Apache-2.0
/// @file
/// A sweep as a table of text.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/sweep/sweep_results.h"

namespace tagfield {

/// The rows by what the sweep aims at, or else by mean error: the best first; those of an adaptive
/// sweep that went furthest before the others.
std::vector<const SweepRow*> best_first(const SweepResults& results);

/// The best rows, some 20, and how many there are. Errors in mm.
std::string sweep_to_text(const SweepResults& results);

}  // namespace tagfield
