// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phase unwrapping aided by the phase change expected from the antenna's motion.
#pragma once

#include <vector>

#include "tagfield/localization/phase_curves/unwrap.h"

namespace tagfield {

/// Unwraps the phase from sample to sample, like unwrap(), but relative to the expected change: the
/// distance of a tag in the direction u from the antenna changes by −u·Δa over the antenna's step
/// Δa, and u changes slowly. u is the state of a Kalman filter, whose uncertainty decides whether
/// whole turns are reliable: a new segment starts if the standard deviation of the expected change
/// exceeds about 0.15 turns, or if the carrier changes. This unwraps noisier phases, and over steps
/// longer than λ/4 once the direction is known. `noise_rad`: standard deviation of the phase noise.
std::vector<PhaseSegment> follow(const std::vector<PhaseSample>& samples, double noise_rad);

}  // namespace tagfield
