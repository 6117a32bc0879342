// SPDX-License-Identifier: Apache-2.0
/// @file
/// Inner loops of segments.h.
#pragma once

#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/segments.h"

namespace tagfield {

/// Lower bound on the share of the power that does not add up: smaller values are indistinguishable
/// from noise.
inline constexpr float kMinLeft = 1e-3f;

/// Σ −f ln(1 − Σ_c |S_c|²/n_c / n) over `segments`, a subset of those of `reads`, at points (x, y,
/// z) as in segment_likelihood(). Phasors outside these segments are not summed. Bit-identical for
/// every instruction set.
Tile segment_sums(const SegmentedReads& reads, const std::vector<const CoherentSegment*>& segments,
                  const Tile& x, const Tile& y, const Tile& z,
                  InstructionSet set = instruction_sets().back());

}  // namespace tagfield
