// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a tag most likely is in a known world, looked for about a rough estimate.
#pragma once

#include "tagfield/localization/joint/internal/traced_likelihood.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// The likeliest place [m] about any of the estimate's candidates, of which there is at least one,
/// to 1 mm: by the likelihood of stretches of the way (stretches.h) with the bends taken out,
/// within so many deviations of a candidate, at most 0.84 m to each side.
Eigen::Vector3d likeliest_place(const TracedSearch& search, const TagEstimate& estimate,
                                double deviations);

/// Likewise within 4 m of where the strongest reads are from, as high as `p_WT` [m]; where no place
/// is likely at all, `p_WT`.
Eigen::Vector3d likeliest_anywhere(const TracedSearch& search, const std::string& tag,
                                   const Eigen::Vector3d& p_WT);

}  // namespace tagfield
