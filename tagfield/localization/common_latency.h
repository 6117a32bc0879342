// SPDX-License-Identifier: Apache-2.0
/// @file
/// Detection, from the reads of all tags together, of a latency of their stamps relative to those
/// of the poses.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Refuses positions that a latency common to all reads would shift by more than three expected
/// errors. The latency maximizes the likelihood of positions near those found (segments.h), summed
/// over the located tags whose phases leave slow errors. It must be more likely than no latency by
/// more than chance achieves in one case in ten thousand, and for at least half of these tags. Amid
/// reflections the phases of a single tag hardly reveal a latency (at_rest.h). A warning reports
/// it. The search covers latencies over which the antennas travel up to 1.2 m. Does not apply to
/// methods that correct poses by a stated error, which may look like a latency.
void refuse_common_latency(const LocalizationProblem& problem, int threads,
                           LocalizationResult& result, Diagnostics& diagnostics);

}  // namespace tagfield
