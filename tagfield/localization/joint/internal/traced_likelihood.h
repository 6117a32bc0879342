// SPDX-License-Identifier: Apache-2.0
/// @file
/// Likelihood of a tag's position in a known world, from the phases without their bends.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/holograms/segments.h"
#include "tagfield/localization/joint/internal/bends.h"
#include "tagfield/localization/joint/internal/reply_phasors.h"

namespace tagfield {

/// Search for one tag.
struct TracedSearch {
  const LocalizationProblem& problem;
  const Sight& sight;
  double min_directness = 0.0;  ///< Minimum, of used replies.
  double noise_rad = 0.0;       ///< Of the phases.
};

/// Reads laid out once for all positions.
struct TracedLayout {
  SegmentedReads reads;
  Eigen::ArrayXd phase_rad;  ///< As measured, per read.
  /// Per read: its antenna, and the index in that antenna's samples.
  std::vector<std::pair<std::string, std::size_t>> sample;
  std::vector<std::size_t> channel;  ///< Per read, from ChannelNumbers.
};

TracedLayout layout_of(const TracedSearch& search);

/// Replies traced to `middle` [m], per read of the layout.
std::vector<NearReply> replies_about(const TracedSearch& search, const TracedLayout& layout,
                                     const std::string& tag, const Eigen::Vector3d& middle);

/// ln of the likelihoods of the tag at points (x, y, z) relative to the middle that the replies
/// were traced to [m], with bends removed. Reads with little of the direct path or near a null of
/// the field are not used.
Tile likelihoods_at(const TracedSearch& search, const TracedLayout& layout,
                    const std::vector<NearReply>& replies, const Tile& x, const Tile& y,
                    const Tile& z);

/// Goodness of fit of a position: ln of its likelihood without outlying reads (outlying.h), and
/// what that would be if only noise remained.
struct Fit {
  double without_outlying = 0.0;
  double attainable = 0.0;
  double freedom = 0.0;  ///< Number of independent samples in these reads.
  /// Sum of squared residual phases over the noise variance, each at most 16; reads not used here
  /// count 16.
  double cost = 0.0;
  // The same sum over the reads that are not outliers, and its value if only noise remains.
  double kept_cost = 0.0;
  double cost_of_noise = 0.0;
};

/// Fit at the position that the replies were traced to.
Fit fit_at_middle(const TracedSearch& search, const TracedLayout& layout,
                  const std::vector<NearReply>& replies);

}  // namespace tagfield
