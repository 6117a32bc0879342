// SPDX-License-Identifier: Apache-2.0
/// @file
/// The key `zones` of a scenario.
#pragma once

#include <vector>

#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// A list of {name, box, readers} with unique names.
std::vector<ZoneSpec> zones_of(YamlMap& scenario);

/// [x0, y0, x1, y1], or [x0, y0, z0, x1, y1, z1], with corners in any order.
Eigen::AlignedBox3d box_of(const YamlValue& value);

}  // namespace tagfield
