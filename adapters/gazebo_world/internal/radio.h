// SPDX-License-Identifier: Apache-2.0
/// @file
/// Physical models as SDF elements.
#pragma once

#include <vector>

#include "adapters/gazebo_world/internal/xml.h"
#include "tagfield/base/setting.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield::gazebo_world_internal {

/// Adds an element per setting, in their order. Throws Error if XML can't represent one.
void add_settings(XMLElement* plugin, const std::vector<RawParameter>& settings);

/// Adds the plugin that describes the world's materials, replacing an existing one, if an antenna
/// has a physical model.
void add_materials(const Scenario& scenario, XMLElement* world);

}  // namespace tagfield::gazebo_world_internal
