// SPDX-License-Identifier: Apache-2.0
/// @file
/// Contribution of the drift of dead reckoning to the tags' errors.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// Adds to each position the drift of the pose from which the tag was read closest to it, by
/// shift_at(): what the body's pose is off by as a whole then moves the tag with it, so the reads
/// can't reveal it. Does nothing without drift, or for methods that correct the poses, which allow
/// for it (joint/drift_steps.h).
void add_drift(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
