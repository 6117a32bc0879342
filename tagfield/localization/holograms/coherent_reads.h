// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phases as they were measured, not unwrapped, for the methods that add up waves
/// (docs/methods.md): which reads may be added up, and over which stretches.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// Reads that are added up as waves: a stretch of one antenna and channel.
struct Aperture {
  Eigen::Index begin = 0;
  Eigen::Index count = 0;
  bool offset_known = false;  ///< The phase offset is 0.
};

/// Length of an aperture that takes in all reads of an antenna and channel [m].
inline constexpr double kWholeAperture = std::numeric_limits<double>::infinity();

/// The reads of all antennas that moved or whose offset is known.
TagPhases coherent_reads(const LocalizationProblem& problem, const SamplesOfTag& samples);

/// Why so few reads can't locate a tag; empty if they might.
std::string too_few(const TagPhases& phases);

/// Each span cut into stretches over which the antenna travelled at most `length` [m]. Stretches of
/// a span have offsets of their own, so only a whole span keeps its known one.
std::vector<Aperture> apertures(const TagPhases& phases, double length);

}  // namespace tagfield
