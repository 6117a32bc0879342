// SPDX-License-Identifier: Apache-2.0
/// @file
/// Keys of a scenario that have no effect in combination with its others: pose.sigma_m with the
/// true pose, a material where no antenna's waves interact with the world. They cause a warning,
/// since whoever writes one expects an effect.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// Warns about keys of `map`, from which `scenario` was read, that nothing uses whatever the world
/// file contains.
void warn_of_idle_keys(YamlMap& map, const Scenario& scenario, Diagnostics& diagnostics);

/// A key and its location.
struct PlacedKey {
  Location location;
  std::string path;
};

/// Keys that only antennas with a physical model use. (Whether there are any is known only with the
/// world, which may add some.)
std::vector<PlacedKey> keys_of_physical_models(YamlMap& map);

/// Warns about `of_physical_models` if no antenna has such a model, and about settings of antennas
/// and tags that have no effect (idle_settings.h), except those from profiles.
void warn_of_idle_settings(const Scenario& scenario,
                           const std::vector<PlacedKey>& of_physical_models,
                           Diagnostics& diagnostics);

/// Whether the setting is from a scenario file or the command line: not from a profile, and not
/// from an SDF file, whose settings are checked when it is read.
bool is_own(const RawParameter& setting);

/// Warns about settings of one antenna or kind of tag, called `whose`, that have no effect.
void warn_of_idle_settings(const RadioModel& antenna, const std::string& whose,
                           Diagnostics& diagnostics);
void warn_of_idle_settings(const TagModel& tag, const std::string& whose, Diagnostics& diagnostics);

}  // namespace tagfield
