// SPDX-License-Identifier: Apache-2.0
/// @file
/// What signal strength tells between places that the phase can't tell apart: an antenna doesn't
/// read better with its back.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Drops candidates of ambiguous tags that the antennas would have to look away from. With antennas
/// that look along their x axis (as a scenario's do), RSSI + 40 log₁₀ r = A + B cos θ + fading is
/// fitted to each candidate over the nearest third of the reads. Levels A of antennas differ by
/// 3 dB; fading counts as often as it is independent along the way. A candidate whose B is negative
/// by over 2.33 standard deviations (one in a hundred) is dropped where another's is positive.
/// Nothing is done without RSSI, or where no antenna's orientation is told (all are the identity),
/// and patterns without a front (B = 0) drop nothing.
void drop_places_behind(const LocalizationProblem& problem, LocalizationResult& result);

/// Refuses located tags that two antennas read whose names, ports or poses must be swapped: the
/// scores B over its standard deviation of all located tags (of 40 at most) together are below
/// −3.72, which chance does in one case of ten thousand, and with the two looking where the other
/// is said to look above 3.72. A warning says which two.
void refuse_swapped_antennas(const LocalizationProblem& problem, LocalizationResult& result,
                             Diagnostics& diagnostics);

}  // namespace tagfield
