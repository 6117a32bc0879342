// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tags and antennas from the world file, added to a scenario.
#pragma once

#include "tagfield/scenario/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// Adds the scene's `rfid` sensors as fixed antennas and its `rfidtag` sensors as tags, with the
/// parameters listed in tagfield/settings/sensor_parameters.h. Throws Error "FILE:LINE: …" on a
/// value that is not a number or out of range. Warns about unknown parameters and about missing
/// published ones.
void add_placements(const Scene& scene, Scenario& scenario, Diagnostics& diagnostics);

}  // namespace tagfield
