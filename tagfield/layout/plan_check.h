// SPDX-License-Identifier: Apache-2.0
/// @file
/// Checks a plan against full simulations of its layout.
#pragma once

#include <cstdint>

#include "tagfield/layout/plan.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {

/// Runs the chosen layout with `count` ≥ 1 samples of tags that the forecast has not seen, with
/// seeds from `first` on, in parallel. Subtracts the plan's margin from every link, as the forecast
/// does; cross reads are counted in a separate run without that margin. Leaves out runs not started
/// when `control.stop` was set.
PlanCheck check_plan(const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                     std::uint64_t first, std::size_t count, const RunControl& control);

}  // namespace tagfield
