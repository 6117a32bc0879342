// SPDX-License-Identifier: Apache-2.0
/// @file
/// Least squares on unwrapped phase: the position, and an offset for each section over which the
/// phase could be unwrapped. The idea is that of Phase ReLock (Tzitzis et al., IEEE JRFID 3, 2019,
/// doi 10.1109/JRFID.2019.2939222): unwrap along the antenna's path, then fit the whole curve.
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {

/// Result of fitting one tag to its unwrapped phase.
struct UnwrappedFit {
  std::string why_not;  ///< Why there is no fit; empty if there is one.
  TagPhases phases;
  HeightModel height;
  std::vector<TagFit> fits;           ///< Local minima, best first; not empty if there is a fit.
  std::vector<std::string> antennas;  ///< Antennas that moved.
  std::size_t reads_followed = 0;     ///< Reads in sections of two or more,
  std::size_t segments = 0;           ///< and the number of these sections.
};

/// Unwraps the phase (phase_following.h), finds possible positions (place_search.h) and fits each.
UnwrappedFit fit_unwrapped(const LocalizationProblem& problem, const std::string& tag,
                           const SamplesOfTag& samples);

/// Method "least_squares": each tag independently.
Method least_squares_method();

}  // namespace tagfield
