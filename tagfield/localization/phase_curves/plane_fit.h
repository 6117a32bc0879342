// SPDX-License-Identifier: Apache-2.0
/// @file
/// Least squares on unwrapped phase in the plane of the tag's height: how well a place explains the
/// segments, each of which has an offset of its own, and the best place near a given one.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// About `reads` of the reads, spread evenly, every segment of `phases` represented by two or more
/// as long as `reads` allows (after that the shorter segments are left out).
TagPhases thinned(const TagPhases& phases, Eigen::Index reads);

/// Unwrapped distance less that of `p` at `height` [m], each segment's mean removed [m].
Eigen::ArrayXd residuals(const TagPhases& phases, double height, const Eigen::Vector2d& p);

/// Sum of the squared residuals [m²].
double sum_of_squares(const TagPhases& phases, double height, const Eigen::Vector2d& p);

/// The local minimum of sum_of_squares() near `start`: Gauss and Newton's method with Levenberg's
/// damping. Finite for finite input.
Eigen::Vector2d refine(const TagPhases& phases, double height, const Eigen::Vector2d& start);

/// Puts cycle slips right: where the residual at `p` jumps by more than a quarter wavelength from
/// one read of a segment to the next, the rest of the segment is moved by whole cycles. How many
/// jumps there were.
std::size_t correct_slips(TagPhases& phases, double height, const Eigen::Vector2d& p);

}  // namespace tagfield
