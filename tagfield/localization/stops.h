// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads at one stop of the antenna: many of them, but one observation.
#pragma once

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Of antennas that moved, consecutive samples of a tag within 1 mm of the first are a stop; those
/// of a stop on one channel become one sample with their mean phase (on the circle, so that few
/// outliers pull little) and RSSI, at the stamp of the first. What an antenna in motion reads stays
/// as it is.
void merge_stops(SamplesByTag& samples);

}  // namespace tagfield
