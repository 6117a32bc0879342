/// @file
/// The world from above, as the page shows it.
#pragma once

#include "simulator/scenario_yaml.h"
#include "tagfield/stream/files.h"

namespace tagfield {

/// Adds top_view.json where the scenario has a world: cut from just above the floor to a little
/// above the highest tag or antenna.
void stage_top_view(const ScenarioWithWorld& loaded, StagedFolder& folder);

}  // namespace tagfield
