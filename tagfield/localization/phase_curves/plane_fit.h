// SPDX-License-Identifier: Apache-2.0
/// @file
/// Least squares on unwrapped phase in the plane of the tag's height: the misfit of a position to
/// the segments, each with its own offset, and the best position near a given one.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// About `reads` of the reads, evenly spread, with at least two of each segment of `phases`; if
/// `reads` is too small for that, the shortest segments are left out.
TagPhases thinned(const TagPhases& phases, Eigen::Index reads);

/// Unwrapped distance minus that of `p` at `height` [m], with each segment's mean removed [m].
Eigen::ArrayXd residuals(const TagPhases& phases, double height, const Eigen::Vector2d& p);

/// Sum of the squared residuals [m²].
double sum_of_squares(const TagPhases& phases, double height, const Eigen::Vector2d& p);

/// The local minimum of sum_of_squares() near `start`, by Gauss-Newton with Levenberg's damping.
/// Finite for finite input.
Eigen::Vector2d refine(const TagPhases& phases, double height, const Eigen::Vector2d& start);

/// Corrects cycle slips: where the residual at `p` jumps by more than a quarter wavelength between
/// successive reads of a segment, the rest of the segment is shifted by whole cycles. Returns the
/// number of jumps.
std::size_t correct_slips(TagPhases& phases, double height, const Eigen::Vector2d& p);

}  // namespace tagfield
