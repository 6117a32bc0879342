// SPDX-License-Identifier: Apache-2.0
/// @file
/// What RSSI says about positions that the phase can't distinguish: an antenna reads no better
/// behind it than in front.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Drops candidates of ambiguous tags that lie behind the antennas. With boresights along the
/// antennas' x axes (as in a scenario), RSSI + 40 log₁₀ r = A + B cos θ + fading is fitted to each
/// candidate over the nearest third of the reads. The antennas' levels A differ by 3 dB (1 σ);
/// reads are weighted by the number of independent fading samples along the path. A candidate whose
/// B is negative by more than 2.33 standard deviations (one in a hundred) is dropped if the B of
/// another is positive. Nothing is done without RSSI or if no antenna's orientation is given (all
/// are the identity); patterns without a front (B = 0) drop nothing.
void drop_candidates_behind(const LocalizationProblem& problem, LocalizationResult& result);

/// Refuses located tags read by two antennas whose names, ports or poses must be swapped: the
/// combined score (B over its standard deviation) of all located tags (40 at most) is below −3.72,
/// a one in ten thousand chance, and above 3.72 once the two antennas' orientations are exchanged.
/// A warning names the two antennas.
void refuse_swapped_antennas(const LocalizationProblem& problem, LocalizationResult& result,
                             Diagnostics& diagnostics);

}  // namespace tagfield
