// SPDX-License-Identifier: Apache-2.0
/// @file
/// A comparison as figures. Each method has a colour of its own throughout.
#pragma once

#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/report/figures.h"

namespace tagfield {

/// Names of the methods, each once, in the suite's order.
std::vector<std::string> method_names(const Bench& bench);

/// The share of tags up to each error, a line for each method of the condition.
Figure errors_figure(const Bench& bench, std::size_t condition);

/// Mean errors as multiples of the bound's, by condition and method.
Figure ratio_figure(const Bench& bench);

/// Mean NEES for each degree of freedom with the band that it should lie in.
Figure nees_figure(const Bench& bench);

/// What the mean error costs in time.
Figure time_figure(const Bench& bench);

/// All of them; without the last where times are left out.
std::vector<Figure> bench_figures(const Bench& bench, Timing timing);

}  // namespace tagfield
