// SPDX-License-Identifier: Apache-2.0
/// @file
/// What each antenna contributes: the same run without it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tagfield/report/summary.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {

/// The scenario without the antennas whose names match one of `patterns` (base/wildcard.h). Throws
/// Error if a pattern matches none, and if no antenna is left.
void take_antennas_away(const std::vector<std::string>& patterns, Scenario& scenario);

/// Number of tags read without each antenna in turn, averaged over `count` ≥ 1 seeds from `first`
/// on, in the scenario's order of antennas. All runs are in parallel. Those not begun when
/// `control.stop` was set are left out. Empty if there is only one antenna. Throws Error if robots
/// navigate by themselves.
std::vector<InventoryWithout> leave_one_out(const Scenario& scenario, std::uint64_t first,
                                            std::size_t count, const RunControl& control);

}  // namespace tagfield
