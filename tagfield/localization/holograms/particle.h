// SPDX-License-Identifier: Apache-2.0
/// @file
/// Particles that stand for the places where a tag may be: spread over all the area in reach, then
/// drawn ever more by the likelihood of the wrapped phases, whose offsets are eliminated.
/// docs/methods.md has the equations and the figures.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tagfield/localization/method.h"

namespace tagfield {

struct ParticleOptions {
  std::size_t particles = 3000;  ///< From 100 to 1000000.
  double max_range_m = 12.0;     ///< Half of the reads are from nearer; over 0.
  double max_height_m = 3.0;     ///< Above or below the antennas, where the height is unknown.
  double least_noise_rad = 0.1;  ///< Standard deviation of a phase, if not more is seen; over 0.
  double min_share = 0.5;        ///< See CoherentJudgement; in (0, 1].
  std::uint64_t seed = 1;        ///< Streams are by seed and the tag's ID.
};

/// "particle": all tags, one by one. Throws Error on options out of their range.
Method particle_method(const ParticleOptions& options = {});

}  // namespace tagfield
