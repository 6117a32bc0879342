// SPDX-License-Identifier: Apache-2.0
/// @file
/// Drives a robot along waypoints.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// Follows the polyline from the robot's start through all waypoints by pure pursuit (Coulter,
/// 1992): it steers along the arc to the point `look_ahead_m` further along the path, which rounds
/// the corners. If that point lies beside or behind the robot, it turns in place first.
class PathFollower {
 public:
  PathFollower(const PlanarPose& start, const std::vector<Eigen::Vector2d>& waypoints,
               const DrivingStyle& style);

  /// The velocity to drive for the next `seconds`; zero once at the end.
  BodyVelocity next(const PlanarPose& pose, double seconds);

  /// Whether the last waypoint is reached.
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  void follow_progress(const Eigen::Vector2d& position);
  [[nodiscard]] Eigen::Vector2d point_at(double arc_length) const;

  std::vector<Eigen::Vector2d> path_;
  std::vector<double> arc_lengths_;  ///< Of the path's corners, from its start [m].
  DrivingStyle style_;
  double progress_ = 0.0;  ///< Arc length of the point nearest to the robot [m].
  bool turning_in_place_ = false;
  bool finished_ = false;
};

}  // namespace tagfield
