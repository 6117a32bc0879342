// SPDX-License-Identifier: Apache-2.0
/// @file
/// How badly residuals fit a pose error that is told.
#pragma once

#include <Eigen/Core>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// −2 ln of the likelihood of a place's residuals [m], but for what all places have in common: Σ
/// over the spans of eᵀ C⁻¹ e, C = `white` I + σ² exp(−|t_i − t_j|/T) + what an offset of which
/// nothing is known adds, of variance 100 m². σ and T are those of phases.pose_error, which must be
/// there; `white` [m²], over 0, is the noise of one read. Reads of a span are in order of time. By
/// Kalman's filter over the pose's error and the offset.
double pose_misfit(const TagPhases& phases, const Eigen::ArrayXd& residuals, double white);

/// Whether reads are too far apart for their residuals to show how fast the told pose errors change
/// (fit_candidates.h: neighbour_differences()). False where none is told.
bool hides_pose_errors(const TagPhases& phases, const Eigen::ArrayXd& residuals);

}  // namespace tagfield
