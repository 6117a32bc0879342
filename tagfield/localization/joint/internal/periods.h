// SPDX-License-Identifier: Apache-2.0
/// @file
/// Periods with reads, separated by pauses.
#pragma once

#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Time from the first to the last of some reads [s].
struct Period {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// Appends the samples' timestamps [s].
void append_times(const std::vector<PhaseSample>& samples, std::vector<double>& times_s);

/// Groups unsorted times into periods, in ascending order: gaps within a period are at most
/// `longest_pause_s`, gaps between periods longer.
std::vector<Period> periods_of(std::vector<double> times_s, double longest_pause_s);

}  // namespace tagfield
