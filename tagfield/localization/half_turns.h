// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phases that are known but for half a turn: many readers report φ or φ + π by chance.
#pragma once

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Whether phases jump by half turns: between reads of a tag on one carrier whose antenna moved
/// less than λ/16 in between, so that the phase turned by less than π/4, cos 2Δφ is greater in the
/// mean than cos Δφ, clearly beyond chance. False where fewer than 100 such pairs tell it.
bool has_half_turns(const SamplesByTag& samples);

/// The same samples with phases that half turns leave alone: twice the phase, as of twice the
/// carrier. All that is done with phase and wavelength thereafter is right, in steps half as long.
void double_phases(SamplesByTag& samples);

}  // namespace tagfield
