// SPDX-License-Identifier: Apache-2.0
/// @file
/// Least squares on unwrapped phase: the place and an offset for each stretch over which the phase
/// could be followed. The idea is Phase ReLock's (Tzitzis et al., IEEE JRFID 3, 2019, doi
/// 10.1109/JRFID.2019.2939222): unwrap along the antenna's way, then fit the whole curve.
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {

/// What the fit of one tag to its unwrapped phase gives.
struct UnwrappedFit {
  std::string why_not;  ///< Why there is none; empty where there is.
  TagPhases phases;
  HeightModel height;
  std::vector<TagFit> fits;           ///< Local minima, best first; not empty where there is a fit.
  std::vector<std::string> antennas;  ///< Those that moved.
  std::size_t reads_followed = 0;     ///< Reads in stretches of two or more,
  std::size_t stretches = 0;          ///< and how many of these there are.
};

/// Follows the phase (phase_following.h), finds the places that may be (place_search.h) and fits
/// each.
UnwrappedFit fit_unwrapped(const LocalizationProblem& problem, const std::string& tag,
                           const SamplesOfTag& samples);

/// "least_squares": all tags, one by one.
Method least_squares_method();

}  // namespace tagfield
