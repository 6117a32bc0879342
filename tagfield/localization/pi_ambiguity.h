// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phases with a π ambiguity (known modulo π): many readers report φ or φ + π at random.
#pragma once

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Whether phases jump by π. Compares pairs of consecutive reads of a tag on one carrier between
/// which the antenna moved less than λ/16, so that the phase changed by less than π/4: true if the
/// mean of cos 2Δφ exceeds that of cos Δφ by clearly more than chance. False if there are fewer
/// than 100 such pairs.
bool has_pi_ambiguity(const SamplesByTag& samples);

/// Makes phases independent of the π ambiguity: doubles the phase and the carrier frequency. All
/// later computations with phase and wavelength remain valid, at half the wavelength.
void double_phases(SamplesByTag& samples);

}  // namespace tagfield
