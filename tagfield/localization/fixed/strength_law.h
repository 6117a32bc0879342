// SPDX-License-Identifier: Apache-2.0
/// @file
/// How strongly antennas at rest read tags over distance: RSSI = level + antenna − slope log₁₀ r +
/// tag + fading, with the law learned from the tags themselves although their places are unknown.
/// docs/methods.md has the equations.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/fixed/fixed_reads.h"
#include "tagfield/localization/signal_strength/lobe.h"

namespace tagfield {

/// What is known of the law before the data are seen.
struct StrengthPrior : Lobe {
  double slope_db = 40.0;  ///< For ten times the distance; free space there and back.
  double slope_sigma_db = 8.0;
  double tag_sigma_db = 2.0;      ///< How tags of one kind differ.
  double antenna_sigma_db = 3.0;  ///< How antennas differ, cables included.
  double fading_db = 4.0;         ///< Of one antenna and tag, as reflections and aims make it.
};

/// Where a tag may be, and what it was read with.
struct TagOnGrid {
  std::vector<Eigen::Vector3d> cells;  ///< Places [m, world], all of them as likely beforehand.
  std::vector<std::size_t> antennas;   ///< Numbers of the antennas that read it,
  Eigen::VectorXd rssi_dbm;            ///< with a strength each.
  /// By cell (row) and antenna: the logarithm of the distance, and the gain of the lobe [dB].
  Eigen::ArrayXXd log_distance, gain_db;
};

/// `names`: all antennas, in the order of their numbers.
TagOnGrid on_grid(const std::vector<std::string>& names, const std::vector<FixedReads>& reads,
                  std::vector<Eigen::Vector3d> cells, const Lobe& lobe);

/// Level, antennas' deviations and slope with their covariance, and the fading.
struct StrengthLaw {
  Eigen::VectorXd mean;  ///< Level [dBm at 1 m], a deviation for each antenna [dB], slope [dB].
  Eigen::MatrixXd covariance;
  double fading_db = 0.0;
};

/// What the tags tell of it together.
struct LearnedLaw {
  std::vector<StrengthLaw> of_tag;  ///< For each tag the law that all others tell.
  StrengthLaw of_all;
  /// ln of how much likelier the strengths are by it than by chance, whatever that scatters.
  double evidence = 0.0;
};

/// Expectation and maximization over the tags' places. `antennas`: how many there are.
LearnedLaw learn_law(const std::vector<TagOnGrid>& tags, std::size_t antennas,
                     const StrengthPrior& prior);

/// ln p(strengths | cell), all constants included.
Eigen::ArrayXd log_strength(const TagOnGrid& tag, const StrengthLaw& law,
                            const StrengthPrior& prior);

}  // namespace tagfield
