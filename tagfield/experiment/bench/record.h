/// @file
/// Estimates of one run beside the truth.
#pragma once

#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/localization/bound.h"
#include "tagfield/localization/problem.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// A record for each tag of the scenario that is no reference tag, with all that can be told
/// without a bound.
std::vector<TagRecord> records_of(const Scenario& scenario, const LocalizationProblem& problem,
                                  const std::vector<TagRead>& reads,
                                  const std::vector<TagEstimate>& estimates);

/// Fills in the bounds of the tags that have one, and how their errors depend on each other.
void judge_by(const Bounds& bounds, MethodRun& run);

/// Fills in the errors that are left after the rigid motion that brings the located tags closest to
/// their places, where there are three or more: a map's frame may be off from the world's as a
/// whole.
void add_aligned_errors(std::vector<TagRecord>& tags);

}  // namespace tagfield
