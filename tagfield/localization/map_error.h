// SPDX-License-Identifier: Apache-2.0
/// @file
/// Contribution of the error of the map, in whose frame poses are given, to the tags' errors.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// Adds J Σ Jᵀ to the covariance of each position, with J = ∂(x, y)/∂(shift, rotation) there and Σ
/// the covariance of the map error, and its trace to the square of the expected error. A shift and
/// a rotation of all poses move all tags with them, so the reads can't reveal them. Tags whose
/// expected error thereby exceeds the limit are no longer located. Does nothing if no map error is
/// known, or for `joint` with reference tags, which anchor the map.
void add_map_error(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
