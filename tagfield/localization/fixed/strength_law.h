// SPDX-License-Identifier: Apache-2.0
/// @file
/// Log-distance path-loss law of stationary antennas: RSSI = level + antenna − slope log₁₀ r + tag
/// + fading, learned from the tags themselves although their positions are unknown. docs/methods.md
/// has the equations.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/fixed/strength_grid.h"

namespace tagfield {

/// Prior of the law.
struct StrengthPrior : Lobe {
  double slope_db = 40.0;  ///< Per decade of distance; 40 is free space, both ways.
  double slope_sigma_db = 8.0;
  double tag_sigma_db = 2.0;      ///< Between tags of one kind.
  double antenna_sigma_db = 3.0;  ///< Between antennas, cables included.
  double fading_db = 4.0;         ///< Per antenna and tag, due to reflections and orientation.
};

/// Level, antenna deviations and slope with their covariance, and the fading.
struct StrengthLaw {
  Eigen::VectorXd mean;  ///< Level [dBm at 1 m], deviation of each antenna [dB], slope [dB].
  Eigen::MatrixXd covariance;
  double fading_db = 0.0;
};

/// Law learned from all tags jointly.
struct LearnedLaw {
  std::vector<StrengthLaw> of_tag;  ///< For each tag, the law learned from all others.
  StrengthLaw of_all;
  /// For each tag, the probabilities of the areas of its places, learned from all others.
  std::vector<Eigen::ArrayXd> areas_of_tag;
  /// ln of the likelihood ratio of this law against pure scatter of any width.
  double evidence = 0.0;
};

/// Expectation maximization over the tags' positions. `antennas`: their number.
LearnedLaw learn_law(const std::vector<TagOnGrid>& tags, std::size_t antennas,
                     const StrengthPrior& prior);

}  // namespace tagfield
