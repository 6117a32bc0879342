// SPDX-License-Identifier: Apache-2.0
/// @file
/// Scenarios from YAML files. docs/scenario.md lists every key with its unit and default.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/locate.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/sdf/load_world.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// Key path and YAML value that replace what stands in the file ("pose.sigma_m", "0.01").
using Override = std::pair<std::string, std::string>;

/// "key.path=value" apart. Throws Error where there is no "=".
Override parse_override(const std::string& argument);

/// Reads a scenario. Paths in the file are relative to the file; those in `overrides` to the
/// current folder. `methods`: those that localization may name, and whose settings it may give.
/// Throws Error "FILE:LINE: …".
Scenario load_scenario(const std::string& path, const std::vector<Override>& overrides,
                       Diagnostics& diagnostics,
                       const std::vector<Method>& methods = built_in_methods());
/// Likewise, warnings unheard.
Scenario load_scenario(const std::string& path, const std::vector<Override>& overrides);

/// A scenario and the world that it plays in.
struct ScenarioWithWorld {
  Scenario scenario;  ///< With the tags and antennas that stand in the world added.
  Scene scene;        ///< Empty where the scenario names no world.
};

/// Reads a scenario and its world; `world_options` add to what the scenario says. Throws Error also
/// if there are no antennas or no tags at all.
ScenarioWithWorld load_scenario_with_world(const std::string& path,
                                           const std::vector<Override>& overrides,
                                           Diagnostics& diagnostics,
                                           const WorldOptions& world_options = {},
                                           const std::vector<Method>& methods = built_in_methods());

/// Likewise from YAML text that stands in no file, for programs that make scenarios themselves.
/// Complaints call it `name`, which is its name too where it says none; paths in it are relative to
/// the current folder. `scene`: its world, instead of `world.path`; null for none.
ScenarioWithWorld scenario_from_text(const std::string& text, const std::string& name,
                                     const std::vector<Override>& overrides, const Scene* scene,
                                     Diagnostics& diagnostics,
                                     const std::vector<Method>& methods = built_in_methods());

}  // namespace tagfield
