// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot that finds its way by itself, put into a run.
#pragma once

#include <cstdint>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/navigation/monte_carlo_localizer.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/robot.h"

namespace tagfield {

/// What a robot that finds its way by itself begins with.
struct SelfDriving {
  const NavigationWorld* world = nullptr;
  const OccupancyGrid* map = nullptr;
  const HitGrid* walls = nullptr;  ///< Where in the map's cells they are; null: nobody knows.
  PlanarPose true_start;           ///< Of the robot that mapped; others begin where they are put.
  PoseEstimate start;              ///< What that robot believes of it, where it is told.
};

/// What a robot believes that was put at `pose` by hand: within 2 cm and 0.6°, one sigma.
PoseEstimate placed_at(const PlanarPose& pose);

/// The robot, with places drawn where the scenario leaves them open. What `driving` points to must
/// outlive it.
Robot self_driving_robot(const Scenario& scenario, RobotSpec robot, const SelfDriving& driving,
                         bool has_mapped, std::uint64_t seed);

}  // namespace tagfield
