// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which of the scenario's own tags are read, and by which antenna.
#pragma once

#include <functional>
#include <vector>

#include "tagfield/planning/coverage.h"

namespace tagfield {

/// Fills in coverage.tags for the antennas of the request: each tag with its own kind and pose over
/// all samples, and the readers that read it in the whole run. A tag is intended for the readers of
/// its zone; without zones, for that of the antenna that comes nearest to it.
void cover_tags(const Scenario& scenario, const std::vector<DriveSample>& samples,
                const CoverageRequest& request, Coverage& coverage,
                const std::function<void(double share)>& on_progress);

/// The verdict, from the readers that read the tag and those it is intended for; `best_db` is the
/// greatest margin of any of its links in any state.
TagVerdict verdict_of(const TagCoverage& tag, double best_db);

}  // namespace tagfield
