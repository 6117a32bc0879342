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
  double radius_m = 0.36;    ///< Of the robot's footprint: reaches a P3-AT's corners.
  double margin_m = 0.05;    ///< Kept from all obstacles seen or mapped, in addition to the radius.
  double clearance_m = 0.3;  ///< More distance than this from the footprint gains nothing.
  double goal_tolerance_m = 0.05;
  double goal_tolerance_rad = 0.05;
  double rate_hz = 20.0;     ///< Of decisions.
  double patience_s = 30.0;  ///< Time without progress to the goal before it gives up.
};

enum class DriveState { kIdle, kDriving, kReached, kRefused, kFailed };

/// Frames: M the map, R the robot's base, L the laser. Uses no clock other than the timestamps it
/// is given and no random numbers: the same calls give the same motion. If timestamps jump back, it
/// forgets what it saw and restarts its timers but keeps the goal.
class GoalDriver {
 public:
  GoalDriver(const GoalDriverSettings& settings, const RigidTransform& X_RL);
  ~GoalDriver();
  GoalDriver(GoalDriver&&) noexcept;

  /// Sets the map for planning from now on; keeps the goal. Throws Error on an empty map.
  void set_map(const OccupancyGrid& map);
  /// Replaces the goal. If it can't be reached, the state is kRefused and reason() says why: the
  /// goal is off the map, not finite, on or too near an obstacle, or in unknown space, there is no
  /// path to it, or the robot itself is in an obstacle.
  void set_goal(const PlanarPose& goal_M, const PlanarPose& pose_M, Time now);
  /// Stands still.
  void cancel();

  /// Forgets all that was seen, for instance when the robot turns out to be elsewhere.
  void forget();
  /// Adds a laser scan; `pose_M` is the robot's pose at its timestamp. NaN ranges are invalid
  /// beams. Ignored if the pose is not finite. The beams may differ from scan to scan.
  void see(const LaserScan& scan, const PlanarPose& pose_M);
  /// The velocity to drive from `now` until the next call. `velocity` is the robot's current one.
  /// Brakes without a finite pose or a usable scan from the last half second, and gives up after
  /// the `patience_s` of the settings.
  BodyVelocity next(const PlanarPose& pose_M, const BodyVelocity& velocity, Time now);

  [[nodiscard]] DriveState state() const;
  /// One line: why a goal was refused or given up.
  [[nodiscard]] const std::string& reason() const;
  /// The path being driven [m, map]; empty if there is none.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& path() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
