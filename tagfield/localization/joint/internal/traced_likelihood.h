// SPDX-License-Identifier: Apache-2.0
/// @file
/// How likely places of a tag are in a known world, by the phases less what its paths do to them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/holograms/stretches.h"
#include "tagfield/localization/joint/internal/bends.h"
#include "tagfield/localization/joint/internal/reply_phasors.h"

namespace tagfield {

/// One tag's search.
struct TracedSearch {
  const LocalizationProblem& problem;
  const Sight& sight;
  double least_directness = 0.0;  ///< Of replies that are used.
  double noise_rad = 0.0;         ///< Of the phases.
};

/// Reads laid out once for all places.
struct TracedLayout {
  StretchedReads reads;
  Eigen::ArrayXd phase_rad;  ///< As measured, by read.
  /// By read: its antenna, and which of that antenna's samples it is.
  std::vector<std::pair<std::string, std::size_t>> sample;
  std::vector<std::size_t> channel;  ///< By read, as ChannelNumbers has them.
};

TracedLayout layout_of(const TracedSearch& search);

/// Traced to `middle` [m], by read of the layout.
std::vector<NearReply> replies_about(const TracedSearch& search, const TracedLayout& layout,
                                     const std::string& tag, const Eigen::Vector3d& middle);

/// ln of the likelihoods of the tag at places (x, y, z) relative to the middle that the replies
/// were traced to [m], with their bends taken out. Reads that hardly came the direct way, or near a
/// null of the field, tell nothing.
Tile likelihoods_at(const TracedSearch& search, const TracedLayout& layout,
                    const std::vector<NearReply>& replies, const Tile& x, const Tile& y,
                    const Tile& z);

/// How well a place explains the reads: ln of its likelihood without outlying reads (outlying.h),
/// and what that would be if only noise were left of them.
struct Fit {
  double without_outlying = 0.0;
  double attainable = 0.0;
  double freedom = 0.0;  ///< Independent samples that these reads come to.
  /// Squares of what is left of the phases over the noise's, summed: of outlying reads, and of
  /// those that tell nothing here, 16.
  double cost = 0.0;
  // The same of the reads that are not outlying, and what it comes to where only noise is left.
  double kept_cost = 0.0;
  double cost_of_noise = 0.0;
};

/// At the place that the replies were traced to.
Fit fit_at_middle(const TracedSearch& search, const TracedLayout& layout,
                  const std::vector<NearReply>& replies);

}  // namespace tagfield
