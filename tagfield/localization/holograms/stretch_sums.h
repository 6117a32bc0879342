// SPDX-License-Identifier: Apache-2.0
/// @file
/// The inner loops of stretches.h.
#pragma once

#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/stretches.h"

namespace tagfield {

/// Waves that add up better than this are told apart from such that do so by noise alone.
inline constexpr float kLeastLeft = 1e-3f;

/// Σ −f ln(1 − Σ_c |S_c|²/n_c / n) over `stretches`, which are some of those of `reads`, at places
/// (x, y, z) as stretch_likelihood() has them. Waves that are in none of them aren't added up. The
/// same to the last bit for each set of instructions.
Tile stretch_sums(const StretchedReads& reads, const std::vector<const CoherentStretch*>& stretches,
                  const Tile& x, const Tile& y, const Tile& z,
                  InstructionSet set = instruction_sets().back());

}  // namespace tagfield
