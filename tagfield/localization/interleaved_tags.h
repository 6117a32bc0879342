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

/// Triples within half a cycle of travel (λ/4; with a π ambiguity λ/8), over which one tag's phase
/// hardly changes but for noise, less what the range to `place` makes of it; reflections, motion,
/// latency and a wrong place change that little. They are apart if two of their three differences
/// are over 0.3 rad, and have a lone read if those are over five times the third. Drawn: of normal
/// noise of any scale at most 29 % have one (from 0.2 rad on under 42 % of those apart); of
/// outliers that are one read in six 30 %; of two tags with 0.1 rad of noise whose reads come by
/// turns at random 62 % in the median, 29 % in one case of 20.
PhaseTriples phase_triples(const TagPhases& phases, const HeightModel& height,
                           const PlaceVector& place);

/// Refuses tags of which over 30 % of at least 60 triples have a lone read, and over half of those
/// that are apart.
void refuse_interleaved_tags(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
