// SPDX-License-Identifier: Apache-2.0
/// @file
/// The places that are held against the reads they came from.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Calls it for each tag with a place, located or ambiguous, that was found and not given, with its
/// samples.
template <typename Call>
void for_each_place(const LocalizationProblem& problem, LocalizationResult& result,
                    const Call& call) {
  for (TagEstimate& estimate : result.estimates) {
    const auto samples = problem.samples.find(estimate.tag);
    if (estimate.candidates.empty() || samples == problem.samples.end()) continue;
    if (problem.reference_tags.count(estimate.tag) == 0) call(samples->second, estimate);
  }
}

}  // namespace tagfield
