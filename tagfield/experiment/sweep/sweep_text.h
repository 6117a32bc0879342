// SPDX-License-Identifier: Apache-2.0
/// @file
/// A sweep as a table of text.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/sweep/sweep_results.h"

namespace tagfield {

/// The rows sorted by the sweep's target, or else by mean error, best first; in an adaptive sweep
/// those of later rungs come before the others.
std::vector<const SweepRow*> best_first(const SweepResults& results);

/// The numbers of points and runs, and about 20 of the best rows. Errors in mm.
std::string sweep_to_text(const SweepResults& results);

}  // namespace tagfield
