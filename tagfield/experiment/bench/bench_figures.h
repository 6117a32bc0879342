// SPDX-License-Identifier: Apache-2.0
/// @file
/// A comparison as figures. Each method has a colour of its own throughout.
#pragma once

#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// Names of the methods, without duplicates, in the suite's order.
std::vector<std::string> method_names(const Bench& bench);

/// The cumulative share of tags over the error, one line per method of the condition.
Figure errors_figure(const Bench& bench, std::size_t condition);

/// Mean errors as multiples of the bound's, by condition and method.
Figure ratio_figure(const Bench& bench);

/// Mean NEES per degree of freedom with the band that it should lie in.
Figure nees_figure(const Bench& bench);

/// Mean error over run time.
Figure time_figure(const Bench& bench);

/// All figures; without the last if times are left out.
std::vector<Figure> bench_figures(const Bench& bench, Timing timing);

}  // namespace tagfield
