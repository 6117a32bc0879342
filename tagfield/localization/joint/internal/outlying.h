// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads whose phase is far from what is traced: near the edge of a shadow a path comes or goes
/// within millimetres of the tag's place.
#pragma once

#include <cstddef>
#include <vector>

namespace tagfield {

/// Of a read, what is left of its phase at a place [rad], and the channel whose offset is in it.
struct PhaseLeft {
  std::size_t channel = 0;
  double rad = 0.0;
};

/// Of reads, how far each is from the middle of its channel [rad], and which of them are outlying.
struct PhaseSpread {
  std::vector<double> off_rad;
  std::vector<bool> outlying;
};

/// Outlying are those over four deviations off: of the noise [rad], or of what is left in the
/// median where that is more. Never more than a seventh of the reads: where more don't fit it is
/// the place that is wrong, and none is named.
PhaseSpread spread_of(const std::vector<PhaseLeft>& left, double noise_rad);

}  // namespace tagfield
