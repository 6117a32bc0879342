// SPDX-License-Identifier: Apache-2.0
/// @file
/// Starting points of the search for a tag: intersections of hyperbolae, best first.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/phase_curves/conic.h"
#include "tagfield/localization/phase_curves/plane_fit.h"
#include "tagfield/localization/phase_curves/unwrap.h"

namespace tagfield {

/// Conics of one segment; all have their first focus at its first read.
using ConicGroup = std::vector<Conic>;

/// A hyperbola for each `stride` [m] of the antenna's travel, by segment, except those that noise
/// made impossible. Short paths use a shorter stride; more than `max_conics` hyperbolae are thinned
/// out, as the cost grows with the cube of their number.
std::vector<ConicGroup> make_conics(const std::vector<PhaseSegment>& segments, double stride,
                                    std::size_t max_conics);

/// Intersections of each hyperbola with all others, in the plane z = `height`.
std::vector<Eigen::Vector2d> intersect_all(const std::vector<ConicGroup>& groups, double height);

/// A position and its quality.
struct Guess {
  Eigen::Vector2d p{0.0, 0.0};
  double sum_of_squares = 0.0;
};

/// Guesses with their quality E over `phases`, best first.
std::vector<Guess> rank(const TagPhases& phases, double height,
                        const std::vector<Eigen::Vector2d>& points);

/// At most `count` of the best of `ranked`, at least `apart` [m] from each other.
std::vector<Eigen::Vector2d> best_distinct(const std::vector<Guess>& ranked, std::size_t count,
                                           double apart);

}  // namespace tagfield
