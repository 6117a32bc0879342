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

}  // namespace tagfield
