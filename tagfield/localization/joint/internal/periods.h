// SPDX-License-Identifier: Apache-2.0
/// @file
/// When there were reads: periods of time, parted by pauses.
#pragma once

#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// From the first of some reads to the last [s].
struct Period {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// Appends the samples' stamps [s].
void append_times(const std::vector<PhaseSample>& samples, std::vector<double>& times_s);

/// Periods of times in any order, in rising order: no two neighbours in one are further apart than
/// `longest_pause_s`, and any two periods are.
std::vector<Period> periods_of(std::vector<double> times_s, double longest_pause_s);

}  // namespace tagfield
