// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which of the scenario's own tags are read, and by which antenna.
#pragma once

#include <functional>
#include <vector>

#include "tagfield/planning/coverage.h"

namespace tagfield {

/// Fills in coverage.tags, whose antennas are those of the request: each tag of its own kind, where
/// and how it lies, over all samples, and who reads it in the whole run. A tag is meant for the
/// readers of its zone; without zones for that of the antenna that comes nearest to it.
void cover_tags(const Scenario& scenario, const std::vector<DriveSample>& samples,
                const CoverageRequest& request, Coverage& coverage,
                const std::function<void(double share)>& on_progress);

/// From who reads it and whom it is meant for; `best_db` is the greatest margin that any link of
/// its has in any state.
TagVerdict verdict_of(const TagCoverage& tag, double best_db);

}  // namespace tagfield
