// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads of two tags under one EPC, taken by an antenna that moves: from read to read the phase
/// jumps to and fro. (Antennas at rest: phase_groups.h.)
#pragma once

#include <cstddef>

#include "tagfield/localization/height_model.h"
#include "tagfield/localization/method.h"

namespace tagfield {

/// Three reads in a row of one antenna and channel.
struct PhaseTriples {
  std::size_t count = 0;
  std::size_t apart = 0;  ///< Of these not all agree, nor two pairs of them,
  std::size_t lone = 0;   ///< and of these two agree, and the third does not.
};

/// Triples within λ/4 of travel, over which one tag's phase hardly changes but for noise, less what
/// the range to `place` makes of it; reflections, motion, latency and a wrong place change that
/// little. They are apart if two of their three differences are over 0.3 rad, and have a lone read
/// if those are over five times the third. Of normal noise of any scale at most 29 % have one, a
/// third of those apart if these are many; of outliers that are one read in six 29 %, three
/// quarters; of two tags whose reads come by turns 30 to 70 %, over half.
PhaseTriples phase_triples(const TagPhases& phases, const HeightModel& height,
                           const PlaceVector& place);

/// Refuses tags of which over 30 % of at least 60 triples have a lone read, and over half of those
/// that are apart.
void refuse_interleaved_tags(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
