// SPDX-License-Identifier: Apache-2.0
/// @file
/// Search for possible positions of a tag, from unwrapped phase in the plane of its height: the
/// minima of the misfit, including mirror images.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "tagfield/localization/phase_curves/plane_fit.h"
#include "tagfield/localization/phase_curves/seeds.h"
#include "tagfield/localization/phase_curves/unwrap.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// Unwrapped phase and the results of the search.
struct PositionSearch {
  double height = 0.0;                  ///< Of the searched plane [m].
  std::vector<PhaseSegment> segments;   ///< Of antennas that moved, with two or more reads each.
  TagPhases phases;                     ///< Of these segments, with cycle slips corrected.
  std::vector<Guess> ranked;            ///< Intersections of hyperbolae, best first.
  std::vector<Eigen::Vector2d> minima;  ///< Best first; empty if nothing was found.
};

/// Unwraps the phase of one antenna's samples: unwrap() or follow().
using Follow = std::function<std::vector<PhaseSegment>(const std::vector<PhaseSample>& samples)>;

/// Segments of the antennas that moved, laid out for a tag at `height` [m].
PositionSearch begin_search(const SamplesOfTag& samples, double height, const Follow& follow);

/// Why the unwrapped phase cannot locate a tag; empty if it might.
std::string why_too_few(const PositionSearch& search);

/// Maximum expected number of cycle slips for a method that fails with one, and for one that
/// tolerates one but not two: one tag in twenty has more.
inline constexpr double kSlipsWithoutOne = 0.05;
inline constexpr double kSlipsWithOne = 0.36;

/// Why the unwrapped phase is unreliable: noise is expected to cause more than `most` undetectable
/// cycle slips (expected_slips()); empty if it is reliable.
std::string why_too_noisy(const SamplesOfTag& samples, double most);

/// Distinct local minima, from the intersections of hyperbolae `stride` [m] apart (at most
/// `max_hyperbolae`) and the mirror images of the best. Corrects the cycle slips that the best
/// shows.
void search_positions(PositionSearch& search, double stride, std::size_t max_hyperbolae);

}  // namespace tagfield
