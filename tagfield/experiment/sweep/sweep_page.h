// SPDX-License-Identifier: Apache-2.0
/// @file
/// A sweep as one HTML page.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/sweep/sweep_results.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// The page, self-contained like report.html. `figures` are those of sweep_figures().
std::string sweep_page(const SweepResults& results, const std::vector<Figure>& figures);

}  // namespace tagfield
