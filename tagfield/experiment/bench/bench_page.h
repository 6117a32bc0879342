// SPDX-License-Identifier: Apache-2.0
/// @file
/// A comparison as one HTML page.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// The page, self-contained like report.html. `figures` are those of bench_figures().
std::string bench_page(const Bench& bench, const std::vector<Figure>& figures, Timing timing);

}  // namespace tagfield
