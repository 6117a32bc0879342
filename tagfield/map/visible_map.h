// SPDX-License-Identifier: Apache-2.0
/// @file
/// The part of a world that a robot's laser can see.
#pragma once

#include <Eigen/Core>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// `truth` (see true_map()) reduced to the cells with a line of sight over free cells to some
/// position that the centre of a round robot of `radius_m` can reach from `start`. Areas that no
/// laser on that robot can see become unknown, including their walls. Rays are cast from positions
/// 0.4 m apart, in 720 directions each. Throws Error if the robot does not fit at `start`.
OccupancyGrid visible_map(const OccupancyGrid& truth, const Eigen::Vector2d& start,
                          double radius_m);

}  // namespace tagfield
