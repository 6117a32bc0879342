// SPDX-License-Identifier: Apache-2.0
/// @file
/// A layout as a scenario: to run directly, or to write to a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tagfield/layout/plan.h"
#include "tagfield/scenario/plan_spec.h"

namespace tagfield {

/// The scenario with its antennas and tags replaced by the layout's antennas and the tags of a
/// sample (tags_of_sample()), for as long as there are tags. Without localization. `less_db` is
/// added to the detuning of all tags.
Scenario scenario_of_layout(const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                            std::uint64_t seed, std::size_t sample, double less_db = 0.0);

/// The same as YAML text for a file in `folder`: the scenario at `path`, with `overrides`, without
/// its section `plan`. Paths of files are relative to `folder`; with "", absolute. Throws Error as
/// load_scenario().
std::string layout_to_yaml(const std::string& path, const std::vector<Override>& overrides,
                           const ScenarioToPlan& to_plan, const PlannedLayout& layout,
                           std::uint64_t seed, const std::string& folder);

}  // namespace tagfield
