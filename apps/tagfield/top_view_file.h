// SPDX-License-Identifier: Apache-2.0
/// @file
/// Top view of the world for the page.
#pragma once

#include <vector>

#include "tagfield/files/staged_folder.h"
#include "tagfield/map/top_view.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {

/// Outlines of everything in the world, from just above the floor to a little above the highest tag
/// or antenna; empty if there is none.
std::vector<Silhouette> outlines_of(const ScenarioWithWorld& loaded);

/// Adds top_view.json with these if the scenario has a world.
void stage_top_view(const ScenarioWithWorld& loaded, StagedFolder& folder);

}  // namespace tagfield
