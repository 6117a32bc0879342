// SPDX-License-Identifier: Apache-2.0
/// @file
/// Search for a tag's most likely position in a known world, near a rough estimate.
#pragma once

#include <vector>

#include "tagfield/localization/joint/internal/traced_likelihood.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

struct LikelyPosition {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();
  double log_likelihood = 0.0;
};

Fit fit_at(const TracedSearch& search, const std::string& tag, const Eigen::Vector3d& p_WT);

/// Whether no other position can be much likelier: hardly more than noise remains there.
bool is_settled(const Fit& fit);

/// Whether a position may be reported: with few independent samples, only if no more than noise
/// remains, by χ².
bool is_believable(const Fit& fit);

/// Nearest local maximum of the likelihood, reached by climbing from `p_WT` [m] in its plane, to
/// 0.25 mm, with all reads.
LikelyPosition climbed(const TracedSearch& search, const std::string& tag,
                       const Eigen::Vector3d& p_WT);

/// Best first.
struct LikelyPositions {
  std::vector<LikelyPosition> places;
  bool is_settled = false;
};

/// At most three of the likeliest positions within `reach` [m], to 1 mm; or only the first settled
/// one, searching outwards.
LikelyPositions likeliest_about(const TracedSearch& search, const std::string& tag,
                                const Eigen::Vector3d& p_WT, double reach);

/// Likeliest position [m] near any of the estimate's candidates (at least one), to 1 mm: by the
/// likelihood over sections of the path (segments.h) with bends removed, within `deviations`
/// standard deviations of a candidate, at most 0.84 m to each side, ring by ring outwards until one
/// is settled.
Eigen::Vector3d likeliest_position(const TracedSearch& search, const TagEstimate& estimate,
                                   double deviations);

/// As likeliest_position(), but within 4 m of the antenna positions of the strongest reads, at the
/// height of `p_WT` [m]; `p_WT` if no position is likely at all.
Eigen::Vector3d likeliest_anywhere(const TracedSearch& search, const std::string& tag,
                                   const Eigen::Vector3d& p_WT);

}  // namespace tagfield
