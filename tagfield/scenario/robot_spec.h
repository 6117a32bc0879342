// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot as a scenario describes it, and how it comes to believe where it is.
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

/// A robot is picked up and put down elsewhere; its wheels don't notice.
struct Carrying {
  Time when;                       ///< Of the drive: mapping is over at 0.
  std::optional<PlanarPose> to_W;  ///< None: anywhere that it could have driven to.
  Location location;
};

/// What a robot is to waves: a box on the ground, its middle over the robot's.
struct RobotBody {
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< Length, width, height.
  Material material;
};

struct RobotSpec {
  std::string name;
  PlanarPose start;
  DriveGeometry drive;
  DrivingStyle style;
  std::vector<Eigen::Vector2d> waypoints;  ///< [m, world]; none for a robot that stands.
  // For robots that find their way by themselves; at most one of waypoints, goals, random goals.
  std::vector<PlanarPose> goals_W;  ///< To be driven to, and to look along.
  int random_goals = 0;             ///< So many, drawn anew at each seed.
  std::vector<Carrying> carried;    ///< In order of time.
  std::optional<RobotBody> body;    ///< None: waves don't notice it.
  Location location;                ///< Where it was written, for messages.
};

/// Whether it has anywhere to go.
inline bool drives(const RobotSpec& robot) {
  return !robot.waypoints.empty() || !robot.goals_W.empty() || robot.random_goals > 0;
}

/// Length of the robot's path over its waypoints or goals, corners not rounded [m].
double planned_length(const RobotSpec& robot);

enum class PoseSource { kTrue, kNoisy, kOdometry, kSlam };

/// "true", "noisy", "odometry", "slam".
std::string to_string(PoseSource source);

struct PoseBelief {
  PoseSource source = PoseSource::kTrue;
  // kNoisy: an Ornstein-Uhlenbeck process in x, y and yaw, stationary from the start.
  double sigma_m = 0.01;         ///< Standard deviation in x and in y.
  double yaw_sigma_rad = 0.0;    ///< Standard deviation of the yaw.
  double time_constant_s = 5.0;  ///< Of the correlation e^(−t/τ); greater than 0.
  // kOdometry
  double wheel_noise = 0.01;  ///< Spread of a wheel's measured travel [m] after 1 m; grows as √m.
};

}  // namespace tagfield
