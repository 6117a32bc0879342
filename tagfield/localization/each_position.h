// SPDX-License-Identifier: Apache-2.0
/// @file
/// Iteration over the positions that are checked against their own reads.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Calls `call(samples, estimate)` for each tag, located or ambiguous, whose position was estimated
/// rather than given.
template <typename Call>
void for_each_position(const LocalizationProblem& problem, LocalizationResult& result,
                       const Call& call) {
  for (TagEstimate& estimate : result.estimates) {
    const auto samples = problem.samples.find(estimate.tag);
    if (estimate.candidates.empty() || samples == problem.samples.end()) continue;
    if (problem.reference_tags.count(estimate.tag) == 0) call(samples->second, estimate);
  }
}

}  // namespace tagfield
