// SPDX-License-Identifier: Apache-2.0
/// @file
/// Maximum likelihood on wrapped phase: one offset for each antenna and channel, or none where it
/// is known; whole cycles are what suits the place best.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// "ml": all tags, one by one, each from the minima of its unwrapped fit (least_squares.h).
Method maximum_likelihood_method();

/// Estimate of one tag.
TagEstimate locate_by_likelihood(const LocalizationProblem& problem, const std::string& tag,
                                 const SamplesOfTag& samples);

}  // namespace tagfield
