// SPDX-License-Identifier: Apache-2.0
/// @file
/// One link of a scenario at a moment of its run, explained.
#pragma once

#include <cstdint>

#include "tagfield/planning/link_explanation.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Runs `scenario` to `time` without reads and explains the link between `antenna` and `tag`, which
/// must be its own, with all others where they are then. Throws Error if the run is over before.
LinkExplanation explain_link_at(const Scenario& scenario, const AntennaSpec& antenna,
                                const TagSpec& tag, Time time, std::uint64_t seed);

/// Whether `a` is to be shown rather than `b`: it reads the tag, or has more to spare in the budget
/// at its weaker end, or is nearer within its range.
bool is_better(const LinkExplanation& a, const LinkExplanation& b);

/// That of the antenna whose link is the best; of equal ones the first. Throws Error on a scenario
/// without antennas, too.
LinkExplanation explain_best_link_at(const Scenario& scenario, const TagSpec& tag, Time time,
                                     std::uint64_t seed);

}  // namespace tagfield
