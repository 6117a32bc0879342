// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where to start looking for a tag: the intersections of hyperbolae, best first.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/phase_curves/conic.h"
#include "tagfield/localization/phase_curves/plane_fit.h"
#include "tagfield/localization/phase_curves/unwrap.h"

namespace tagfield {

/// The conics of one segment all have their first focus at its first read.
using ConicGroup = std::vector<Conic>;

/// A hyperbola for each `stride` [m] that the antenna went, by segment; those that noise made
/// impossible are left out. A short path gets a shorter stride, and where they are more than
/// `max_conics` a longer one, as the cost grows with the cube of their number.
std::vector<ConicGroup> make_conics(const std::vector<PhaseSegment>& segments, double stride,
                                    std::size_t max_conics);

/// Each hyperbola intersected with all others, in the plane z = `height`.
std::vector<Eigen::Vector2d> intersect_all(const std::vector<ConicGroup>& groups, double height);

/// A place and its quality.
struct Guess {
  Eigen::Vector2d p{0.0, 0.0};
  double sum_of_squares = 0.0;
};

/// Guesses with their quality E over `phases`, best first.
std::vector<Guess> rank(const TagPhases& phases, double height,
                        const std::vector<Eigen::Vector2d>& points);

/// The best at most `count` of `ranked` that lie further than `apart` [m] from each other.
std::vector<Eigen::Vector2d> best_distinct(const std::vector<Guess>& ranked, std::size_t count,
                                           double apart);

}  // namespace tagfield
