// SPDX-License-Identifier: Apache-2.0
/// @file
/// How much each effect of the physical models costs: the experiment repeated with each effect
/// alone and with all others.
#pragma once

#include <vector>

#include "tagfield/experiment/experiment.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/report/summary.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// The scenario with only those effects of its antennas enabled that are enabled in it and in
/// `effects`.
Scenario with_effects(const Scenario& scenario, const RadioEffects& effects);

/// Effects enabled in any antenna of the scenario, in the order of kEffectSwitches. Effects that
/// would change nothing (reflections of order 0, no inventory) are left out.
std::vector<EffectSwitch> effects_in(const Scenario& scenario);

/// Runs the scenario without any effect, then with each one alone, then with all but each one, then
/// with all; `seeds` runs of each from `first` on. The runs share seeds, so noise does not hide the
/// differences. Empty if no antenna has a physical model. Stops early with partial results, as
/// run_seeds() does.
std::vector<EffectCost> break_down(const Scenario& scenario, std::uint64_t first, std::size_t seeds,
                                   const RunControl& control, Diagnostics& diagnostics,
                                   const NavigationWorld* world = nullptr);

}  // namespace tagfield
