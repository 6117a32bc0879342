// SPDX-License-Identifier: Apache-2.0
/// @file
/// What to drive to follow a way, were there nothing in it.
#pragma once

#include "tagfield/motion/speed_limits.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/navigation/polyline.h"

namespace tagfield {

struct PursuitStyle {
  SpeedLimits limits;      ///< Of the drive.
  double speed_m_s = 0.3;  ///< Wanted along the way.
  double look_ahead_m = 0.4;
};

/// Pure pursuit (Coulter, 1992) that slows down towards the end, and turns on the spot first where
/// the way lies beside or behind the robot.
class PathPursuit {
 public:
  PathPursuit(Polyline way, const PursuitStyle& style) : way_(std::move(way)), style_(style) {}

  /// Moves on along the way to the foot of `pose_M`, and no farther back.
  void follow(const PlanarPose& pose_M);
  [[nodiscard]] BodyVelocity wanted(const PlanarPose& pose_M);

  [[nodiscard]] const Polyline& way() const { return way_; }
  [[nodiscard]] double along_m() const { return along_m_; }
  [[nodiscard]] double remaining_m() const { return way_.length_m() - along_m_; }
  /// Of the robot from the way.
  [[nodiscard]] double distance_m() const { return distance_m_; }
  /// How far the robot must turn before it can drive on [rad]; 0 where it need not.
  [[nodiscard]] double to_turn_rad(const PlanarPose& pose_M) const;

 private:
  [[nodiscard]] double bearing(const PlanarPose& pose_M) const;

  Polyline way_;
  PursuitStyle style_;
  double along_m_ = 0.0;
  double distance_m_ = 0.0;
  bool is_turning_ = false;
};

/// The rate at which to turn by `angle` [rad/s], so that the drive can stop there.
double turn_rate(double angle_rad, const SpeedLimits& limits);

}  // namespace tagfield
