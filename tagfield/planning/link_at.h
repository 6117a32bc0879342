// SPDX-License-Identifier: Apache-2.0
/// @file
/// Explanation of one link of a scenario at a moment of its run.
#pragma once

#include <cstdint>

#include "tagfield/planning/link_explanation.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Runs `scenario` to `time` without reads and explains the link between `antenna` and `tag`, both
/// of which must belong to it, with everything else where it is at that time. Throws Error if the
/// run is over before.
LinkExplanation explain_link_at(const Scenario& scenario, const AntennaSpec& antenna,
                                const TagSpec& tag, Time time, std::uint64_t seed);

/// Whether `a` is the better link to show: it reads the tag, or has the larger margin at its weaker
/// end, or is farther inside its range.
bool is_better(const LinkExplanation& a, const LinkExplanation& b);

/// Explains the link of the antenna with the best link to the tag; of equal ones, the first. Throws
/// Error as explain_link_at(), and on a scenario without antennas.
LinkExplanation explain_best_link_at(const Scenario& scenario, const TagSpec& tag, Time time,
                                     std::uint64_t seed);

}  // namespace tagfield
