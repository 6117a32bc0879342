// SPDX-License-Identifier: Apache-2.0
/// @file
/// Velocity commands to follow a path as if it were free of obstacles.
#pragma once

#include "tagfield/motion/speed_limits.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/navigation/polyline.h"

namespace tagfield {

struct PursuitStyle {
  SpeedLimits limits;      ///< Of the drive.
  double speed_m_s = 0.3;  ///< Wanted along the path.
  double look_ahead_m = 0.4;
};

/// Pure pursuit (Coulter, 1992) that slows down towards the end, and first turns on the spot if the
/// path lies beside or behind the robot.
class PathPursuit {
 public:
  PathPursuit(Polyline way, const PursuitStyle& style) : way_(std::move(way)), style_(style) {}

  /// Advances along the path to the point nearest to `pose_M`, never backwards.
  void follow(const PlanarPose& pose_M);
  [[nodiscard]] BodyVelocity wanted(const PlanarPose& pose_M);

  [[nodiscard]] const Polyline& way() const { return way_; }
  [[nodiscard]] double along_m() const { return along_m_; }
  [[nodiscard]] double remaining_m() const { return way_.length_m() - along_m_; }
  /// Distance of the robot from the path.
  [[nodiscard]] double distance_m() const { return distance_m_; }
  /// Angle that the robot must turn before it can drive on [rad]; 0 if it need not.
  [[nodiscard]] double to_turn_rad(const PlanarPose& pose_M) const;

 private:
  [[nodiscard]] double bearing(const PlanarPose& pose_M) const;

  Polyline way_;
  PursuitStyle style_;
  double along_m_ = 0.0;
  double distance_m_ = 0.0;
  bool is_turning_ = false;
};

/// The rate at which to turn by `angle_rad` [rad/s] such that the drive can stop there.
double turn_rate(double angle_rad, const SpeedLimits& limits);

}  // namespace tagfield
