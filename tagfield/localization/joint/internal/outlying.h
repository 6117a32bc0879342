// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads whose phase is far from the traced one: near a shadow boundary, a path appears or vanishes
/// within millimetres of the tag's position.
#pragma once

#include <cstddef>
#include <vector>

namespace tagfield {

/// Residual phase of a read at a position [rad], and the channel whose offset it includes.
struct PhaseLeft {
  std::size_t channel = 0;
  double rad = 0.0;
};

/// Absolute deviation of each read from the mean phase of its channel [rad], and which reads are
/// outliers.
struct PhaseSpread {
  std::vector<double> off_rad;
  std::vector<bool> outlying;
};

/// Outliers deviate by more than four standard deviations: of the noise [rad], or from the median
/// of the deviations if that is larger. If over a seventh of the reads deviate that much, the
/// position is wrong and no read is marked.
PhaseSpread spread_of(const std::vector<PhaseLeft>& left, double noise_rad);

}  // namespace tagfield
