// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tags and antennas that stand in the world file, made part of a scenario.
#pragma once

#include "tagfield/scenario/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// Adds the scene's `rfid` sensors as fixed antennas and its `rfidtag` sensors as tags, with the
/// parameters that tagfield/reader/sensor_parameters.h lists. Throws Error "FILE:LINE: …" on a
/// value that is no number or out of its range; unknown parameters, and published ones that are
/// missing, are warned of.
void add_placements(const Scene& scene, Scenario& scenario, Diagnostics& diagnostics);

}  // namespace tagfield
