// SPDX-License-Identifier: Apache-2.0
/// @file
/// A world made ready for robots that find their way by themselves.
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

/// May be shared by several runs at once. The map's frame M is the world's W, since a run begins at
/// a known pose.
struct NavigationWorld {
  LaserWorld laser;
  std::vector<Silhouette> low_things;      ///< What the laser does not see, for the driver.
  std::optional<OccupancyGrid> given_map;  ///< Where the scenario names one.
  OccupancyGrid true_map;                  ///< At the laser's height, to compare with.
  RobotClearance clearance;
  /// Where a robot can get to from the start of the one that maps, with room to spare for what a
  /// map and a belief may be off: two of the map's cells.
  std::vector<Eigen::Vector2d> floor;
};

/// Throws Error where the scenario has no world, no robot that drives, or one that starts or is
/// carried into a wall, and on a map that can't be read or is of no use.
NavigationWorld navigation_world(const Scenario& scenario, const Scene& scene,
                                 Diagnostics& diagnostics);

/// The robot that makes the map: the first that has anywhere to go. Throws Error if there is none.
const RobotSpec& mapping_robot(const Scenario& scenario);

/// The map that a robot drives by, as opposed to that it localizes on.
OccupancyGrid driving_map(const OccupancyGrid& map, const NavigationWorld& world);

}  // namespace tagfield
