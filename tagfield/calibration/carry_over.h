// SPDX-License-Identifier: Apache-2.0
/// @file
/// Several experiments' calibrations made one that is good for another experiment, as far as what
/// they tell is the same in all of them.
#pragma once

#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/calibration/calibration.h"

namespace tagfield {

/// Each figure of an antenna is held out in turn: by the mean of the others it must be met twice
/// as well as by leaving it as it was, over all experiments, and its mean must be beyond twice its
/// standard error. What passes gets the mean, with the scatter between experiments in its standard
/// deviation for one more experiment. What doesn't is left as it was (`observable: false`) with a
/// warning that says how much it differs. Noise is the median. Offsets are given for channels on
/// which all experiments agree (rms under 0.25 rad). Antennas of which nothing carries over, or
/// that not all experiments calibrated, are left out. At least three experiments.
Calibration carried_over(const std::vector<Calibration>& experiments, Diagnostics& diagnostics);

}  // namespace tagfield
