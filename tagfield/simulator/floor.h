// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where in a world a robot can get to.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/base/random.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/robot_clearance.h"

namespace tagfield {

/// Middles of those free cells of `truth` that a disc of `radius_m` can be moved to from `start`,
/// or from the nearest place to it, within kNearStart, where such a disc fits, without touching a
/// solid, an obstacle that always stands, or unknown ground. In the order of the cells; none where
/// it fits nowhere near the start.
std::vector<Eigen::Vector2d> reachable_floor(const OccupancyGrid& truth,
                                             const RobotClearance& clearance,
                                             const std::vector<ObstacleSpec>& obstacles,
                                             const Eigen::Vector2d& start, double radius_m);

inline constexpr double kNearStart = 0.5;  ///< [m]

/// One of the places, each as likely, turned any way. Throws Error where there is none.
PlanarPose random_place(const std::vector<Eigen::Vector2d>& floor, RandomStream& stream);

}  // namespace tagfield
