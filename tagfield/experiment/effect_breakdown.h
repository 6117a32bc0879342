// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which effect of the physical models costs how much: the experiment over and over, with each
/// effect alone and with all but that.
#pragma once

#include <vector>

#include "tagfield/experiment/experiment.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/report/summary.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// The scenario with those effects of its antennas on that are on in it and in `effects`.
Scenario with_effects(const Scenario& scenario, const RadioEffects& effects);

/// Effects that any antenna of the scenario has on, in the order of kEffectSwitches. An effect that
/// would change nothing (reflections of order 0, an inventory that is not given) is not among them.
std::vector<EffectSwitch> effects_in(const Scenario& scenario);

/// First without any effect, then with each alone, then with all but each, then with all; `seeds`
/// runs of each from `first` on. The runs share seeds, so noise does not hide the differences.
/// Empty where no antenna has a physical model. Stops early, with what there is, as run_seeds()
/// does.
std::vector<EffectCost> break_down(const Scenario& scenario, std::uint64_t first, std::size_t seeds,
                                   const RunControl& control, Diagnostics& diagnostics,
                                   const NavigationWorld* world = nullptr);

}  // namespace tagfield
