// SPDX-License-Identifier: Apache-2.0
/// @file
/// One antenna of a scenario, from YAML.
#pragma once

#include "tagfield/base/error.h"
#include "tagfield/scenario/internal/radio_yaml.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// The entry of `antennas`, with the scenario's defaults. Throws Error "FILE:LINE: …".
AntennaSpec antenna_of(YamlMap map, const RadioDefaults& radio, Diagnostics& diagnostics);

}  // namespace tagfield
