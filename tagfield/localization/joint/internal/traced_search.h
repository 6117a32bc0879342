// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a tag most likely is in a known world, looked for about a rough estimate.
#pragma once

#include "tagfield/localization/joint/internal/bends.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// One tag's search.
struct TracedSearch {
  const LocalizationProblem& problem;
  const Sight& sight;
  double least_directness = 0.0;  ///< Of replies that are used.
};

/// The likeliest place [m] about any of the estimate's candidates, of which there is at least one,
/// to 3 mm: by the likelihood of stretches of the way (stretches.h) with the bends taken out,
/// within two and a half deviations of a candidate, at most 0.84 m to each side.
Eigen::Vector3d likeliest_place(const TracedSearch& search, const TagEstimate& estimate);

}  // namespace tagfield
