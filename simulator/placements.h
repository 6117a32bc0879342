/// @file
/// Tags and antennas that stand in the world file, made part of a scenario.
#pragma once

#include "simulator/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// Adds the scene's `rfid` sensors as fixed antennas and its `rfidtag` sensors as tags. Parameters
/// have their published names, meanings and defaults: `frequency` [Hz] 865.7e6, `noisephi` [rad]
/// 0.1, `noiserssi` 0.005, `range` [m] 5, `communication_gain` 250, `optional_distribution` none,
/// `optional_distribution_params` (numbers between spaces), and `update_rate` [Hz] 15. What is not
/// given is warned of, as the published plugin does. Throws Error "FILE:LINE: …" on a value that
/// is no number or out of its range; unknown parameters are warned of.
void add_placements(const Scene& scene, Scenario& scenario, Diagnostics& diagnostics);

}  // namespace tagfield
