// SPDX-License-Identifier: Apache-2.0
/// @file
/// Areas where a robot must not drive although its laser sees nothing there.
#pragma once

#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/map/top_view.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// `map` with all cells occupied that the silhouettes cover or touch. A laser's scan plane passes
/// above a low shelf board and below a table top; top_view() of the world between the floor and the
/// robot's height includes them. `q_MW` is the pose of the world frame in the map frame. Meant for
/// GoalDriver and frontiers(); localization needs the map as the laser sees it.
OccupancyGrid with_keep_out(const OccupancyGrid& map, const std::vector<Silhouette>& silhouettes_W,
                            const PlanarPose& q_MW);

}  // namespace tagfield
