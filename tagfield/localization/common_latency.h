// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether the reads of all tags together say that their stamps are late against those of the
/// poses.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Refuses places that one latency of all reads puts elsewhere, by more than three times what they
/// are expected to be off. The latency is that at which places near those found are likeliest
/// (stretches.h), summed over the located tags whose phases leave slow errors; it must be likelier
/// than none by more than chance makes it in one case of ten thousand, and with half of these tags.
/// Amid reflections one tag's phases hardly tell it (at_rest.h). A warning says what it is.
/// Latencies over which the antennas travel up to 1.2 m are looked for. Not of methods that correct
/// poses.
void refuse_common_latency(const LocalizationProblem& problem, int threads,
                           LocalizationResult& result, Diagnostics& diagnostics);

}  // namespace tagfield
