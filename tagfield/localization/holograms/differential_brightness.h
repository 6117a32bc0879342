// SPDX-License-Identifier: Apache-2.0
/// @file
/// The inner loop of `dah`: sums of weighted phase differences.
#pragma once

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/wave_sums.h"

namespace tagfield {

/// Σ over apertures of |Σ_i w_i e^{jε_i}| with ε_i = (φ_i − φ_0) − k (r_i − r_0) wrapped, read 0
/// being the reference, and the weight w = P(|N(0, (√2 σ)²)| > |ε|) = erfc(|ε|/2σ). For long
/// apertures, the mean over four references. Bit-identical for every instruction set.
Tile differential_brightness(const SearchReads& reads, double noise_rad, const Tile& x,
                             const Tile& y, InstructionSet set = instruction_sets().back());

}  // namespace tagfield
