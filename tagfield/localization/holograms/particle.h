// SPDX-License-Identifier: Apache-2.0
/// @file
/// Particles that represent possible tag positions: spread over the whole area in reach, then
/// annealed towards the likelihood of the wrapped phases, whose offsets are eliminated.
/// docs/methods.md has the equations and the figures.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tagfield/localization/method.h"

namespace tagfield {

struct ParticleOptions {
  std::size_t particles = 3000;  ///< From 100 to 1000000.
  double max_range_m = 12.0;     ///< Half of the reads are from within this range; over 0.
  double max_height_m = 3.0;     ///< Above or below the antennas, if the height is unknown.
  double min_noise_rad = 0.1;    ///< Lower bound on a phase's standard deviation; over 0.
  double min_share = 0.5;        ///< See CoherentJudgement; in (0, 1].
  std::uint64_t seed = 1;        ///< A stream depends on the seed and the tag's ID.
};

/// Method "particle": each tag independently. Throws Error on options out of range.
Method particle_method(const ParticleOptions& options = {});

}  // namespace tagfield
