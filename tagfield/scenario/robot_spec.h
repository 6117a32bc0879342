// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot as described by a scenario, and the source of its believed pose.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/time.h"
#include "tagfield/channel/material.h"
#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// A robot is picked up and put down elsewhere, unnoticed by its odometry.
struct Kidnapping {
  Time when;  ///< Time since the start of the drive, which is the end of mapping.
  std::optional<PlanarPose> to_W;  ///< None: drawn from all poses it could have driven to.
  Location location;
};

/// A robot's body as seen by waves: a box on the floor, centred on the robot's base.
struct RobotBody {
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< Length, width, height.
  Material material;
};

struct RobotSpec {
  std::string name;
  PlanarPose start;
  DriveGeometry drive;
  DrivingStyle style;
  std::vector<Eigen::Vector2d> waypoints;  ///< [m, world]; none for a stationary robot.
  // For robots that navigate by themselves; at most one of waypoints, goals, random goals.
  std::vector<PlanarPose> goals_W;    ///< Poses to drive to, including the final heading.
  int random_goals = 0;               ///< Number of goals drawn anew for each seed.
  std::vector<Kidnapping> kidnapped;  ///< In chronological order.
  std::optional<RobotBody> body;      ///< None: invisible to waves.
  Location location;                  ///< Location in the file, for messages.
};

/// Whether it has waypoints or goals.
inline bool drives(const RobotSpec& robot) {
  return !robot.waypoints.empty() || !robot.goals_W.empty() || robot.random_goals > 0;
}

/// Length of the robot's path through its waypoints or goals, without rounded corners [m].
double planned_length(const RobotSpec& robot);

enum class PoseSource { kTrue, kNoisy, kOdometry, kSlam };

/// "true", "noisy", "odometry", "slam".
std::string to_string(PoseSource source);

struct PoseBelief {
  PoseSource source = PoseSource::kTrue;
  // kNoisy: an Ornstein-Uhlenbeck process in x, y and yaw, stationary from the start.
  double sigma_m = 0.01;         ///< Standard deviation in x and in y.
  double yaw_sigma_rad = 0.0;    ///< Standard deviation of the yaw.
  double time_constant_s = 5.0;  ///< τ of the correlation e^(−t/τ); greater than 0.
  // kOdometry
  double wheel_noise = 0.01;  ///< Spread of a wheel's measured travel [m] after 1 m; grows as √m.
};

}  // namespace tagfield
