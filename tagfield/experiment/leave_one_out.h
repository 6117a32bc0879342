// SPDX-License-Identifier: Apache-2.0
/// @file
/// What each antenna is worth: the same run without it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tagfield/report/summary.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {

/// The scenario without the antennas whose names match one of `patterns` (base/wildcard.h). Throws
/// Error where one matches none, and where no antenna is left.
void take_antennas_away(const std::vector<std::string>& patterns, Scenario& scenario);

/// Tags read without each antenna in turn, the mean over `count` ≥ 1 seeds from `first` on, in the
/// scenario's order of antennas; in parallel over all. Those not begun when `control.stop` was set
/// are left out. Empty where there is but one antenna. Throws Error where robots find their way by
/// themselves.
std::vector<InventoryWithout> leave_one_out(const Scenario& scenario, std::uint64_t first,
                                            std::size_t count, const RunControl& control);

}  // namespace tagfield
