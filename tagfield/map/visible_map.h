// SPDX-License-Identifier: Apache-2.0
/// @file
/// The part of a world that a robot's laser can see at all.
#pragma once

#include <Eigen/Core>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// `truth` (see true_map()) with those cells alone that are seen from somewhere: in a straight line
/// over free cells, from a place that the middle of a round robot of `radius_m` can reach from
/// `start`. Nooks that no laser on that robot looks into become unknown, with their walls. Looks
/// from places 0.4 m apart, in 720 directions each. Throws Error where the robot does not fit at
/// `start`.
OccupancyGrid visible_map(const OccupancyGrid& truth, const Eigen::Vector2d& start,
                          double radius_m);

}  // namespace tagfield
