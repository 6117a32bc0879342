// SPDX-License-Identifier: Apache-2.0
/// @file
/// Contribution of the error of the map, in whose frame poses are given, to the tags' errors.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// Covariance of the shift [m²] of what is at `p`, J Σ Jᵀ, due to a shift and a rotation about
/// `origin` of covariance Σ (x, y, yaw), with J = ∂(x, y)/∂(shift, rotation).
Eigen::Matrix2d shift_at(const Eigen::Vector2d& origin, const Eigen::Matrix3d& covariance,
                         const Eigen::Vector2d& p);

/// Adds what `shift_of` gives to the covariance of each position, and its trace to the square of
/// the expected error. Tags whose expected error thereby exceeds the limit are no longer located,
/// with `cause` as the reason. Reference tags stay as they are.
void add_shifts(const LocalizationProblem& problem, const std::string& cause,
                const std::function<Eigen::Matrix2d(const std::string& tag,
                                                    const Eigen::Vector2d& p_WT)>& shift_of,
                LocalizationResult& result);

/// Adds shift_at() the map's error. A shift and a rotation of all poses move all tags with them, so
/// the reads can't reveal them. Does nothing if no map error is known, or for `joint` with
/// reference tags, which anchor the map.
void add_map_error(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
