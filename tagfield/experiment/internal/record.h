/// @file
/// Estimates of one run beside the truth.
#pragma once

#include <vector>

#include "tagfield/experiment/bench/bench.h"
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

/// Fills in the errors that are left after the rigid motion that brings the located tags closest to
/// their places, where there are three or more: a map's frame may be off from the world's as a
/// whole.
void add_aligned_errors(std::vector<TagRecord>& tags);

}  // namespace tagfield
