// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot that navigates by itself, set up for a run.
#pragma once

#include <cstdint>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/navigation/monte_carlo_localizer.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/robot.h"

namespace tagfield {

/// The initial state of a robot that navigates by itself.
struct SelfDriving {
  const NavigationWorld* world = nullptr;
  const OccupancyGrid* map = nullptr;
  const HitGrid* walls = nullptr;  ///< Positions of walls within the map's cells; null: unknown.
  PlanarPose true_start;  ///< Of the robot that mapped; others start at their specified poses.
  PoseEstimate start;     ///< That robot's belief of it, if its start is known.
};

/// Belief of a robot that was placed at `pose` by hand: within 2 cm and 0.6°, one sigma.
PoseEstimate placed_at(const PlanarPose& pose);

/// The robot, with random poses where the scenario leaves them open. What `driving` points to must
/// outlive it.
Robot self_driving_robot(const Scenario& scenario, RobotSpec robot, const SelfDriving& driving,
                         bool has_mapped, std::uint64_t seed);

}  // namespace tagfield
