// SPDX-License-Identifier: Apache-2.0
/// @file
/// The floor of a world that a robot can reach.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/base/random.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/robot_clearance.h"

namespace tagfield {

/// Centres of the free cells of `truth` that a disc of `radius_m` can reach from `start` without
/// touching a solid, a stationary permanent obstacle, or unknown ground. If the disc does not fit
/// at `start`, it begins at the nearest cell within kNearStart where it fits. In the order of the
/// cells; empty if there is no such cell.
std::vector<Eigen::Vector2d> reachable_floor(const OccupancyGrid& truth,
                                             const RobotClearance& clearance,
                                             const std::vector<ObstacleSpec>& obstacles,
                                             const Eigen::Vector2d& start, double radius_m);

inline constexpr double kNearStart = 0.5;  ///< [m]

/// A uniformly random position of `floor`, with a uniformly random heading. Throws Error if `floor`
/// is empty.
PlanarPose random_position(const std::vector<Eigen::Vector2d>& floor, RandomStream& stream);

}  // namespace tagfield
