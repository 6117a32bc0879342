// SPDX-License-Identifier: Apache-2.0
/// @file
/// A world prepared for robots that navigate by themselves.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/map/top_view.h"
#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/floor.h"
#include "tagfield/simulator/robot_clearance.h"
#include "tagfield/simulator/robot_senses.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// May be shared by concurrent runs. The map's frame M is the world's W, since a run begins at a
/// known pose.
struct NavigationWorld {
  LaserWorld laser;
  std::vector<Silhouette> low_things;  ///< Obstacles that the laser does not see, for the driver.
  std::optional<OccupancyGrid> given_map;  ///< If the scenario names one.
  OccupancyGrid true_map;                  ///< At the laser's height, for comparison.
  RobotClearance clearance;
  /// Positions that a robot can reach from the start of the mapping robot, with a margin of two of
  /// the map's cells for errors of map and belief.
  std::vector<Eigen::Vector2d> floor;
};

/// Throws Error if the scenario has no world, no robot that drives, or one that starts in or is
/// carried into a wall, and on a map that can't be read or is unusable.
NavigationWorld navigation_world(const Scenario& scenario, const Scene& scene,
                                 Diagnostics& diagnostics);

/// The robot that makes the map: the first that has waypoints or goals. Throws Error if there is
/// none.
const RobotSpec& mapping_robot(const Scenario& scenario);

/// The map for a robot's path planning, as opposed to the one for its localization.
OccupancyGrid driving_map(const OccupancyGrid& map, const NavigationWorld& world);

}  // namespace tagfield
