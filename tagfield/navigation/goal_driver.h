// SPDX-License-Identifier: Apache-2.0
/// @file
/// Drives a robot to goals on a map, clear of what its laser sees: what move_base does.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/laser/laser_scan.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/speed_limits.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

struct GoalDriverSettings {
  SpeedLimits limits;        ///< Of the drive.
  double speed_m_s = 0.3;    ///< Wanted along the path.
  double radius_m = 0.36;    ///< Of the robot's outline, seen from above: a P3-AT's corners.
  double margin_m = 0.05;    ///< Kept from all that is seen or mapped, beside the radius.
  double clearance_m = 0.3;  ///< Beyond this distance from the outline nothing is gained.
  double goal_tolerance_m = 0.05;
  double goal_tolerance_rad = 0.05;
  double rate_hz = 20.0;     ///< Of decisions.
  double patience_s = 30.0;  ///< Without getting nearer to the goal before it gives up.
};

enum class DriveState { kIdle, kDriving, kReached, kRefused, kFailed };

/// Frames: M the map, R the robot's base, L the laser. Knows no clock but the stamps it is given
/// and draws no random numbers: the same calls give the same motion. Stamps that go back make it
/// forget what it saw and begin to time anew; the goal stays.
class GoalDriver {
 public:
  GoalDriver(const GoalDriverSettings& settings, const RigidTransform& X_RL);
  ~GoalDriver();
  GoalDriver(GoalDriver&&) noexcept;

  /// Plans are made on this from now on; keeps the goal. Throws Error on an empty map.
  void set_map(const OccupancyGrid& map);
  /// Replaces the goal. Where it can't be reached the state is kRefused and reason() says why: off
  /// the map, not finite, on or too near an obstacle, on unknown ground, no way there, the robot
  /// itself in an obstacle.
  void set_goal(const PlanarPose& goal_M, const PlanarPose& pose_M, Time now);
  /// Stands still.
  void cancel();

  /// Nothing that was seen counts any more, as where the robot turns out to be elsewhere.
  void forget();
  /// What the laser saw; `pose_M` is the robot's at the scan's stamp. NaN ranges are invalid beams;
  /// a pose that is not finite is passed over; scans may differ in their beams.
  void see(const LaserScan& scan, const PlanarPose& pose_M);
  /// What to drive from `now` until the next call. `velocity` is the robot's present one. Brakes
  /// without a usable scan of the last half second or a finite pose, and gives up after as long as
  /// the settings have patience.
  BodyVelocity next(const PlanarPose& pose_M, const BodyVelocity& velocity, Time now);

  [[nodiscard]] DriveState state() const;
  /// One line: why a goal was refused or given up.
  [[nodiscard]] const std::string& reason() const;
  /// The way that is being driven [m, map]; empty where there is none.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& path() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
