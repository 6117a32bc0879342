// SPDX-License-Identifier: Apache-2.0
/// @file
/// Misfit of residuals under a stated pose error.
#pragma once

#include <Eigen/Core>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// −2 ln of the likelihood of a position's residuals [m], up to a constant common to all positions:
/// Σ over the spans of eᵀ C⁻¹ e, C = `white` I + σ² exp(−|t_i − t_j|/T) + an unknown offset of
/// variance 100 m². σ and T are those of phases.pose_error, which must be set; `white` > 0 [m²] is
/// the noise variance of a single read. The reads of a span must be sorted by time. Uses a Kalman
/// filter over the pose error and the offset.
double pose_misfit(const TagPhases& phases, const Eigen::ArrayXd& residuals, double white);

/// Whether reads are too far apart for their residuals to show how fast the stated pose errors
/// change (fit_candidates.h: neighbour_differences()). False if none is stated.
bool hides_pose_errors(const TagPhases& phases, const Eigen::ArrayXd& residuals);

}  // namespace tagfield
