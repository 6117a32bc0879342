// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the error of the map that poses are on adds to tags' errors.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// Adds J Σ Jᵀ to the covariance of each place, Σ the map's error and J = ∂(x, y)/∂(shift, turn)
/// there, and its trace to the square of the expected error: a shift and a turn of all poses move
/// all tags alike, so no read tells of them. Places that thereby exceed the limit are no longer
/// located. Nothing where no map's error is known, and with reference tags, by which `joint` holds
/// the map where it is.
void add_map_error(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
