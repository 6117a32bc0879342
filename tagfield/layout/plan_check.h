// SPDX-License-Identifier: Apache-2.0
/// @file
/// A plan against full simulations of its layout.
#pragma once

#include <cstdint>

#include "tagfield/layout/plan.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {

/// Runs the chosen layout with `count` ≥ 1 samples of tags that the forecast has not seen, seeds
/// from `first` on, in parallel. What the plan has to spare on every link is taken off there, too,
/// as the forecast does; cross reads are counted in another run, without that. Those not begun when
/// `control.stop` was set are left out.
PlanCheck check_plan(const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                     std::uint64_t first, std::size_t count, const RunControl& control);

}  // namespace tagfield
