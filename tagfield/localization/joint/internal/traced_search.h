// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a tag most likely is in a known world, looked for about a rough estimate.
#pragma once

#include <vector>

#include "tagfield/localization/joint/internal/traced_likelihood.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

struct LikelyPlace {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();
  double log_likelihood = 0.0;
};

Fit fit_at(const TracedSearch& search, const std::string& tag, const Eigen::Vector3d& p_WT);

/// Whether no place can be much likelier: the reads leave hardly more than their noise there.
bool is_settled(const Fit& fit);

/// Whether a place may be claimed: of few independent samples only where they leave no more than
/// noise, by χ².
bool is_believable(const Fit& fit);

/// From `p_WT` [m] uphill in its plane to the nearest place that is likelier than all about it, to
/// 0.25 mm, by all reads.
LikelyPlace climbed(const TracedSearch& search, const std::string& tag,
                    const Eigen::Vector3d& p_WT);

/// The best first.
struct LikelyPlaces {
  std::vector<LikelyPlace> places;
  bool is_settled = false;
};

/// The likeliest places within `reach` [m], to 1 mm, at most three; or the first on the way
/// outwards that is settled.
LikelyPlaces likeliest_about(const TracedSearch& search, const std::string& tag,
                             const Eigen::Vector3d& p_WT, double reach);

/// The likeliest place [m] about any of the estimate's candidates, of which there is at least one,
/// to 1 mm: by the likelihood of stretches of the way (stretches.h) with the bends taken out,
/// within so many deviations of a candidate, at most 0.84 m to each side; ring by ring outwards
/// until one is settled.
Eigen::Vector3d likeliest_place(const TracedSearch& search, const TagEstimate& estimate,
                                double deviations);

/// Likewise within 4 m of where the strongest reads are from, as high as `p_WT` [m]; where no place
/// is likely at all, `p_WT`.
Eigen::Vector3d likeliest_anywhere(const TracedSearch& search, const std::string& tag,
                                   const Eigen::Vector3d& p_WT);

}  // namespace tagfield
