// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads of two tags under one EPC by a moving antenna: the phase jumps back and forth from read to
/// read. (Stationary antennas: phase_groups.h.)
#pragma once

#include <cstddef>

#include "tagfield/localization/height_model.h"
#include "tagfield/localization/method.h"

namespace tagfield {

/// Counts of triples: three consecutive reads of one antenna and channel.
struct PhaseTriples {
  std::size_t count = 0;
  std::size_t apart = 0;  ///< Those in which at most one pair of reads agrees.
  /// Those of them in which one pair agrees and the third read does not.
  std::size_t lone = 0;
};

/// Counts triples within half a cycle of travel (λ/4; with a π ambiguity λ/8). Over such a distance
/// the phase of one tag, minus that predicted from the range to `place`, hardly changes except for
/// noise; reflections, motion, latency and a wrong position affect it little. A triple is apart if
/// two of its three differences are over 0.3 rad, and has a lone read if those are over five times
/// the third. In simulation, normal noise of any scale gives at most 29 % lone reads (from 0.2 rad
/// on under 42 % of the triples that are apart); outliers at one read in six give 30 %; two tags
/// with 0.1 rad of noise whose reads alternate at random give 62 % in the median, 29 % in one case
/// in 20.
PhaseTriples phase_triples(const TagPhases& phases, const HeightModel& height,
                           const PositionVector& place);

/// Refuses tags with at least 60 triples of which over 30 % have a lone read, if these are also
/// over half of the triples that are apart.
void refuse_interleaved_tags(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
