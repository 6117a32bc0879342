// SPDX-License-Identifier: Apache-2.0
/// @file
/// The world from above, as the page shows it.
#pragma once

#include <vector>

#include "tagfield/files/staged_folder.h"
#include "tagfield/map/top_view.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {

/// All that stands in the world, cut from just above the floor to a little above the highest tag or
/// antenna; empty where there is none.
std::vector<Silhouette> outlines_of(const ScenarioWithWorld& loaded);

/// Adds top_view.json with the same where the scenario has a world.
void stage_top_view(const ScenarioWithWorld& loaded, StagedFolder& folder);

}  // namespace tagfield
