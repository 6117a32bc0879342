// SPDX-License-Identifier: Apache-2.0
/// @file
/// Maximum likelihood on wrapped phase: one offset for each antenna and channel, or none if it is
/// known; whole cycles are those that fit the position best.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Method "ml": each tag independently, starting from the minima of its unwrapped fit
/// (least_squares.h).
Method maximum_likelihood_method();

/// Estimate of one tag.
TagEstimate locate_by_likelihood(const LocalizationProblem& problem, const std::string& tag,
                                 const SamplesOfTag& samples);

}  // namespace tagfield
