// SPDX-License-Identifier: Apache-2.0
/// @file
/// Estimation of the phase noise from the phases alone.
#pragma once

#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// Standard deviation [rad] of the phase noise, from the second differences of the phase over
/// evenly spaced samples (a median, so gaps and turns don't disturb it); 0 if there are too few.
double phase_noise(const std::vector<PhaseSample>& samples);

/// The largest of any antenna [rad], at least `least`.
double largest_phase_noise(const SamplesOfTag& samples, double least);

/// Expected number of cycle slips of unwrapping that no residual shows: where the noise of a phase
/// difference, √2 σ, exceeds π, which is the case for 2 Q(π/(√2 σ)) = erfc(π/(2σ)) of the reads. σ
/// is each antenna's phase_noise().
double expected_slips(const SamplesOfTag& samples);

}  // namespace tagfield
