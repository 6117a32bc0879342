// SPDX-License-Identifier: Apache-2.0
/// @file
/// How noisy phases are, as they show by themselves.
#pragma once

#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Standard deviation [rad] of the phase noise, from the second differences of the phase over
/// evenly spaced samples (a median, so gaps and turns don't disturb it); 0 where too few tell it.
double phase_noise(const std::vector<PhaseSample>& samples);

/// The largest of any antenna [rad], at least `least`.
double largest_phase_noise(const SamplesOfTag& samples, double least);

/// Cycle slips that unwrapping makes and no residual shows, in the mean: where the noise of two
/// phases, √2 σ, turns their difference by more than π, in 2 Q(π/(√2 σ)) = erfc(π/(2σ)) of the
/// reads. σ is each antenna's phase_noise().
double expected_slips(const SamplesOfTag& samples);

}  // namespace tagfield
