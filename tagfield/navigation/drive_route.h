// SPDX-License-Identifier: Apache-2.0
/// @file
/// The path that a driving robot follows, and when it replans.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/navigation/drive_senses.h"
#include "tagfield/navigation/floor_room.h"
#include "tagfield/navigation/path_pursuit.h"

namespace tagfield {

class DriveRoute {
 public:
  DriveRoute(const RobotRoom& size, const PursuitStyle& style) : size_(size), style_(style) {}

  /// Begins a drive to `goal_M`. Returns why there is no path; "" if there is one.
  std::string begin(const DriveSenses& senses, const PlanarPose& pose_M, const PlanarPose& goal_M,
                    Time now);
  /// Replans around the map's obstacles and those seen by the laser. If there is no such path,
  /// ignores the latter, since they may go away. If there is still none, keeps the current path.
  /// Returns whether the path is new.
  bool plan_anew(const DriveSenses& senses, const PlanarPose& pose_M, Time now);
  /// Advances along the path to the robot's position. Replans if the robot is far off its path, if
  /// something has blocked the path for a while, or if the map is new. Returns whether the path is
  /// new.
  bool follow(const DriveSenses& senses, const PlanarPose& pose_M, Time now);
  void map_changed() { map_is_new_ = true; }
  /// Handles a jump of time back to `now`.
  void rewind(Time now);
  void clear();

  /// Must not be called before begin() has found a path, nor after clear().
  [[nodiscard]] PathPursuit& pursuit() { return *pursuit_; }
  [[nodiscard]] const PathPursuit& pursuit() const { return *pursuit_; }
  /// From the robot's position at planning time to the goal [m, map].
  [[nodiscard]] const std::vector<Eigen::Vector2d>& way() const { return way_; }
  /// The last position at which an obstacle that is not on the map blocked the path.
  [[nodiscard]] const std::optional<Eigen::Vector2d>& block_M() const { return block_M_; }
  /// Why the last planning attempt failed; "" if it succeeded.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

 private:
  void look_for_blocks(const DriveSenses& senses, const PlanarPose& pose_M, Time now);

  RobotRoom size_;
  PursuitStyle style_;
  PlanarPose goal_M_;
  std::vector<Eigen::Vector2d> way_;
  std::optional<PathPursuit> pursuit_;
  std::optional<Time> blocked_since_;
  std::optional<Eigen::Vector2d> block_M_;
  std::string refusal_;
  Time planned_;
  bool map_is_new_ = false;
};

}  // namespace tagfield
