// SPDX-License-Identifier: Apache-2.0
/// @file
/// Keys of a scenario that change nothing beside the others that it has: pose.sigma_m with the true
/// pose, a material where no antenna's waves meet the world. Whoever writes one expects something
/// of it, and is told.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// Warns of keys of `map`, of which `scenario` was read, that nothing makes use of, whatever is in
/// the world file.
void warn_of_idle_keys(YamlMap& map, const Scenario& scenario, Diagnostics& diagnostics);

/// A key and where it stands.
struct PlacedKey {
  Location location;
  std::string path;
};

/// Keys that only antennas with a physical model make use of. (That there is none is known only
/// with the world, which may bring some.)
std::vector<PlacedKey> keys_of_physical_models(YamlMap& map);

/// Warns of `of_physical_models` where no antenna has such a model, and of settings of antennas and
/// tags that change nothing (idle_settings.h), those of profiles aside.
void warn_of_idle_settings(const Scenario& scenario,
                           const std::vector<PlacedKey>& of_physical_models,
                           Diagnostics& diagnostics);

/// Whether the setting stands in a file of the scenario or on the command line: not in a profile,
/// and not in an SDF file, whose settings are looked at as they are read.
bool is_own(const RawParameter& setting);

/// Warns of settings of one antenna or kind of tag, called `whose`, that change nothing in it.
void warn_of_idle_settings(const RadioModel& antenna, const std::string& whose,
                           Diagnostics& diagnostics);
void warn_of_idle_settings(const TagModel& tag, const std::string& whose, Diagnostics& diagnostics);

}  // namespace tagfield
