// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a tag may be at all, from unwrapped phase in the plane of its height: the minima of the
/// misfit, among them mirror images.
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

/// Unwrapped phase and what was found in it.
struct PlaceSearch {
  double height = 0.0;                  ///< Of the plane that is searched [m].
  std::vector<PhaseSegment> segments;   ///< Of antennas that moved, of two reads or more.
  TagPhases phases;                     ///< Of these, slips corrected.
  std::vector<Guess> ranked;            ///< Intersections of hyperbolae, best first.
  std::vector<Eigen::Vector2d> minima;  ///< Best first; empty where nothing was found.
};

/// How the phase of one antenna's samples is followed: unwrap() or follow().
using Follow = std::function<std::vector<PhaseSegment>(const std::vector<PhaseSample>& samples)>;

/// Segments of the antennas that moved, laid out for a tag at `height` [m].
PlaceSearch begin_search(const SamplesOfTag& samples, double height, const Follow& follow);

/// Why the phase that could be followed can't locate a tag; empty if it might.
std::string why_too_few(const PlaceSearch& search);

/// Most cycle slips that may be expected, of a method that is led astray by one, and of one that
/// bridges one but not two: one tag in twenty has more.
inline constexpr double kSlipsWithoutOne = 0.05;
inline constexpr double kSlipsWithOne = 0.36;

/// Why an unwrapped phase can't be trusted: the noise makes more cycle slips that nothing shows
/// (expected_slips()) than `most`; empty if it can.
std::string why_too_noisy(const SamplesOfTag& samples, double most);

/// Distinct local minima, from the intersections of hyperbolae `stride` [m] apart (at most
/// `max_hyperbolae`) and the mirror images of the best. Corrects the cycle slips that the best
/// shows.
void search_places(PlaceSearch& search, double stride, std::size_t max_hyperbolae);

}  // namespace tagfield
