/// @file
/// A comparison as one HTML page.
#pragma once

#include <string>
#include <vector>

#include "bench/bench.h"
#include "bench/bench_files.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// The page, self-contained as report.html. `figures` are those of bench_figures().
std::string bench_page(const Bench& bench, const std::vector<Figure>& figures, Timing timing);

}  // namespace tagfield
