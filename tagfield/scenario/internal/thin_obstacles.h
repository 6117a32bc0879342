// SPDX-License-Identifier: Apache-2.0
/// @file
/// Obstacles too long and thin for their model.
#pragma once

#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Warns of obstacles of a material that are over 2 m long and over four times as long as wide:
/// waves meet a screen at their centre (docs/moving_bodies.md), which such a wall is not.
void warn_of_thin_obstacles(const std::vector<ObstacleSpec>& obstacles, Diagnostics& diagnostics);

}  // namespace tagfield
