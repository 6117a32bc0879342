// SPDX-License-Identifier: Apache-2.0
/// @file
/// Measured phases, not unwrapped, for the methods that sum phasors coherently (docs/methods.md):
/// which reads may be summed, and over which apertures.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// Reads whose phasors are summed coherently: an interval of the reads of one antenna and channel.
struct Aperture {
  Eigen::Index begin = 0;
  Eigen::Index count = 0;
  bool offset_known = false;  ///< The phase offset is 0.
};

/// Length of an aperture that includes all reads of an antenna and channel [m].
inline constexpr double kWholeAperture = std::numeric_limits<double>::infinity();

/// The reads of all antennas that moved or whose offset is known.
TagPhases coherent_reads(const LocalizationProblem& problem, const SamplesOfTag& samples);

/// Why so few reads can't locate a tag; empty if they might.
std::string too_few(const TagPhases& phases);

/// The spans, each cut into apertures over which the antenna travelled at most `length` [m]. Every
/// piece of a span has its own offset, so only a whole span keeps its known offset.
std::vector<Aperture> apertures(const TagPhases& phases, double length);

}  // namespace tagfield
