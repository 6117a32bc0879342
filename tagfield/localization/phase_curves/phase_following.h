// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phase histories without their jumps of 2π, followed by what the antenna's motion lets expect.
#pragma once

#include <vector>

#include "tagfield/localization/phase_curves/unwrap.h"

namespace tagfield {

/// Follows the phase from sample to sample, as unwrap() does, but against the change that is
/// expected: a tag in the direction u from the antenna changes its distance by −u·Δa over the
/// antenna's step Δa, and u changes slowly. A Kalman filter has u as its state, and its own
/// uncertainty says whether the whole turns are sure: where the expected change is uncertain by
/// more than a third of a turn (one standard deviation), or the carrier changes, a new segment
/// starts. So noisier phases are followed, and over longer steps than λ/4 once the direction is
/// known. `noise_rad`: standard deviation of the phase noise.
std::vector<PhaseSegment> follow(const std::vector<PhaseSample>& samples, double noise_rad);

}  // namespace tagfield
