// SPDX-License-Identifier: Apache-2.0
/// @file
/// Combination of several experiments' calibrations into one for another experiment, as far as they
/// agree.
#pragma once

#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/calibration/calibration.h"

namespace tagfield {

/// Cross-validates each parameter of an antenna by leaving out one experiment at a time: the mean
/// of the others must predict it with at most half the rms error of no correction, and its mean
/// must exceed twice its standard error. If so, the result is the mean, with a standard deviation
/// that covers one more experiment, given the scatter between experiments. If not, the parameter is
/// left uncorrected (`observable: false`), with a warning that says how much it differs if each
/// experiment determines it clearly. The noise is the median. Offsets are given for channels on
/// which all experiments agree (rms under 0.25 rad). Antennas for which nothing carries over, or
/// that not all experiments calibrated, are left out. Needs at least three experiments.
Calibration carried_over(const std::vector<Calibration>& experiments, Diagnostics& diagnostics);

}  // namespace tagfield
