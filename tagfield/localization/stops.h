// SPDX-License-Identifier: Apache-2.0
/// @file
/// Merging of reads at a stop of the antenna: many reads, but a single observation.
#pragma once

#include "tagfield/localization/problem.h"

namespace tagfield {

/// For antennas that moved, consecutive samples of a tag within 1 mm of the first form a stop.
/// Those of a stop on one channel are merged into one sample with their circular mean phase (on
/// which a few outliers have little influence) and mean RSSI, at the stamp of the first. Reads of
/// an antenna in motion are unchanged.
void merge_stops(SamplesByTag& samples);

}  // namespace tagfield
