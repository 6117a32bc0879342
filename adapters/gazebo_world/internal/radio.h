// SPDX-License-Identifier: Apache-2.0
/// @file
/// Physical models as SDF elements.
#pragma once

#include <vector>

#include "adapters/gazebo_world/internal/xml.h"
#include "tagfield/base/setting.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield::gazebo_world_internal {

/// An element a setting, in their order. Throws Error if XML can't hold one.
void add_settings(XMLElement* plugin, const std::vector<RawParameter>& settings);

/// The plugin that says what the world is made of, in place of one that stands there, where an
/// antenna has a physical model.
void add_materials(const Scenario& scenario, XMLElement* world);

}  // namespace tagfield::gazebo_world_internal
