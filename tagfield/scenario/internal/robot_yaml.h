// SPDX-License-Identifier: Apache-2.0
/// @file
/// One robot of a scenario, from YAML.
#pragma once

#include "tagfield/channel/radio_world.h"
#include "tagfield/scenario/robot_spec.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// The entry of `robots`; names of materials are looked up in `world`. Throws Error "FILE:LINE: …".
RobotSpec robot_of(YamlMap map, const RadioWorldOptions& world);

}  // namespace tagfield
