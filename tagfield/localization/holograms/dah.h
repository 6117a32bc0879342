// SPDX-License-Identifier: Apache-2.0
/// @file
/// Differential augmented holograms, after Yang et al., "Tagoram: real-time tracking of mobile RFID
/// tags to high precision using COTS devices", MobiCom 2014, doi 10.1145/2639108.2639111: phase
/// differences against a reference read, each weighted by how probable it is. docs/methods.md.
#pragma once

#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/hologram.h"
#include "tagfield/localization/method.h"

namespace tagfield {

struct DahOptions : SearchOptions {
  double min_noise_rad = 0.1;  ///< Lower bound on a phase's standard deviation; over 0.
  double min_share = 0.5;      ///< See CoherentJudgement; in (0, 1].
};

/// Σ over apertures of |Σ_i w_i e^{jε_i}| with ε_i = (φ_i − φ_0) − k (r_i − r_0) wrapped, read 0
/// being the reference, and the weight w = P(|N(0, (√2 σ)²)| > |ε|) = erfc(|ε|/2σ). For long
/// apertures, the mean over four references. Bit-identical for every instruction set.
Tile differential_brightness(const SearchReads& reads, double noise_rad, const Tile& x,
                             const Tile& y, InstructionSet set = instruction_sets().back());

/// Method "dah": each tag independently. Throws Error on options out of range.
Method dah_method(const DahOptions& options = {});

}  // namespace tagfield
