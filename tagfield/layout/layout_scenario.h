// SPDX-License-Identifier: Apache-2.0
/// @file
/// A layout as a scenario: to run at once, or written down.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tagfield/layout/plan.h"
#include "tagfield/scenario/plan_spec.h"

namespace tagfield {

/// The scenario with the layout's antennas and the tags of a sample (tags_of_sample()) instead of
/// its own, for as long as tags are there. Nothing is located. With `less_db` all tags are detuned
/// by as much more.
Scenario scenario_of_layout(const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                            std::uint64_t seed, std::size_t sample, double less_db = 0.0);

/// The same as YAML text for a file in `folder`: the scenario at `path`, with `overrides`, less its
/// section `plan`. Files that it names are found from `folder`; with "" from anywhere, by absolute
/// paths. Throws Error as load_scenario().
std::string layout_to_yaml(const std::string& path, const std::vector<Override>& overrides,
                           const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                           std::uint64_t seed, const std::string& folder);

}  // namespace tagfield
