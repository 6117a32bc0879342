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
};

/// Reads laid out once for all places.
struct TracedLayout {
  StretchedReads reads;
  Eigen::ArrayXd phase_rad;  ///< As measured, by read.
  /// By read: its antenna, and which of that antenna's samples it is.
  std::vector<std::pair<std::string, std::size_t>> sample;
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

}  // namespace tagfield
