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

/// Key path and YAML value that override those in the file ("pose.sigma_m", "0.01").
using Override = std::pair<std::string, std::string>;

/// Splits "key.path=value". Throws Error if there is no "=".
Override parse_override(const std::string& argument);

/// Reads a scenario. Paths in the file are relative to the file; those in `overrides` to the
/// current folder. `methods`: those available to localization, with their settings. Throws Error
/// "FILE:LINE: …".
Scenario load_scenario(const std::string& path, const std::vector<Override>& overrides,
                       Diagnostics& diagnostics,
                       const std::vector<Method>& methods = built_in_methods());
/// Overload that discards warnings.
Scenario load_scenario(const std::string& path, const std::vector<Override>& overrides);

/// A scenario and its world.
struct ScenarioWithWorld {
  Scenario scenario;  ///< Including the tags and antennas of the world.
  Scene scene;        ///< Empty if the scenario has no world.
};

/// Reads a scenario and its world; `world_options` add to the scenario's. Throws Error also if
/// there are no antennas or no tags at all.
ScenarioWithWorld load_scenario_with_world(const std::string& path,
                                           const std::vector<Override>& overrides,
                                           Diagnostics& diagnostics,
                                           const WorldOptions& world_options = {},
                                           const std::vector<Method>& methods = built_in_methods());

/// Same, but from YAML text rather than a file, for programs that generate scenarios. Messages call
/// it `name`, which is also its default name; paths in it are relative to the current folder.
/// `scene`: its world, instead of `world.path`; null for none.
ScenarioWithWorld scenario_from_text(const std::string& text, const std::string& name,
                                     const std::vector<Override>& overrides, const Scene* scene,
                                     Diagnostics& diagnostics,
                                     const std::vector<Method>& methods = built_in_methods());

}  // namespace tagfield
