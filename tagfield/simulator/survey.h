// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot that maps an unknown world.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/navigation/monte_carlo_localizer.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/robot.h"

namespace tagfield {

struct Survey {
  OccupancyGrid map;
  std::optional<HitGrid> walls;  ///< Positions of walls within the map's cells.
  /// Of x, y, yaw of the start on the map [m², m·rad, rad²], as estimated by mapping.
  Eigen::Matrix3d start_covariance = Eigen::Matrix3d::Zero();
  PoseEstimate end;  ///< Believed pose of the robot at the end: near its start.
  PlanarPose true_end_W;
  std::vector<StampedPose> true_path;      ///< X_WR at 10 Hz,
  std::vector<StampedPose> believed_path;  ///< and as believed by the robot at the time.
  double path_length_m = 0.0;
  double simulated_s = 0.0;
  bool complete = true;               ///< False if it was stopped, or ended by its time limit.
  std::vector<std::string> given_up;  ///< Goals that it could not reach, and why.
};

/// Drives from robot.start to frontiers until no reachable one is left, and then back to the start.
Survey survey(const NavigationSpec& navigation, const NavigationWorld& world,
              const RobotSpec& robot, double time_step_s, std::uint64_t seed, int threads,
              const std::atomic<bool>* stop,
              const std::function<void(double simulated_s)>& on_progress);

}  // namespace tagfield
