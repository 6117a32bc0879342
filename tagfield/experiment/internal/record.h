// SPDX-License-Identifier: Apache-2.0
/// @file
/// Estimates of one run compared with the truth.
#pragma once

#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/localization/bound.h"
#include "tagfield/localization/problem.h"
#include "tagfield/report/summary.h"

namespace tagfield {

/// A record for each outcome of a tag that is not a reference tag, with everything that doesn't
/// need a bound.
std::vector<TagRecord> records_of(const LocalizationProblem& problem,
                                  const std::vector<TagOutcome>& outcomes);

/// Fills in the bounds of the tags that have one, and the correlation of their errors.
void judge_by(const Bounds& bounds, MethodRun& run);

/// An error of a located tag above this multiple of the expected one is a false claim.
inline constexpr double kFalseClaim = 5.0;

/// Marks the false claims: located tags that moved, those whose reads have faults that leave no
/// true position for this method, and those with an error above kFalseClaim times the expected one,
/// if one was stated.
void judge_claims(const Faults& faults, MethodRun& run);

/// Fills in the errors that remain after the rigid motion that best aligns the located tags with
/// their true positions, if there are at least three: a map's frame may be offset from the world's
/// as a whole.
void add_aligned_errors(std::vector<TagRecord>& tags);

}  // namespace tagfield
