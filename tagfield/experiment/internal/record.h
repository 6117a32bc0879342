// SPDX-License-Identifier: Apache-2.0
/// @file
/// Estimates of one run beside the truth.
#pragma once

#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/localization/bound.h"
#include "tagfield/localization/problem.h"
#include "tagfield/report/summary.h"

namespace tagfield {

/// A record for each outcome of a tag that is no reference tag, with all that can be told without a
/// bound.
std::vector<TagRecord> records_of(const LocalizationProblem& problem,
                                  const std::vector<TagOutcome>& outcomes);

/// Fills in the bounds of the tags that have one, and how their errors depend on each other.
void judge_by(const Bounds& bounds, MethodRun& run);

/// A located tag's error over this many times the expected one is a false claim.
inline constexpr double kFalseClaim = 5.0;

/// Marks the false claims: of tags that moved, of reads whose faults leave no place that could be
/// true for this method, and those off by over five times their expected error, where one was told.
void judge_claims(const Faults& faults, MethodRun& run);

/// Fills in the errors that are left after the rigid motion that brings the located tags closest to
/// their places, where there are three or more: a map's frame may be off from the world's as a
/// whole.
void add_aligned_errors(std::vector<TagRecord>& tags);

}  // namespace tagfield
