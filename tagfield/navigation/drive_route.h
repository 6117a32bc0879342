// SPDX-License-Identifier: Apache-2.0
/// @file
/// The way that a driving robot follows, and when it takes another.
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

  /// Begins a drive to `goal_M`. Returns why there is no way; "" where there is one.
  std::string begin(const DriveSenses& senses, const PlanarPose& pose_M, const PlanarPose& goal_M,
                    Time now);
  /// Looks for a way around what was seen, or, where there is none, past the map's obstacles only:
  /// what was seen may go away. Where there is none either it keeps the way that it has. Returns
  /// whether it has a new one.
  bool plan_anew(const DriveSenses& senses, const PlanarPose& pose_M, Time now);
  /// Moves on along the way to where the robot is, and plans anew where it is far off its way,
  /// where something has stood on the way for a while, and on a new map. Returns whether it has a
  /// new way.
  bool follow(const DriveSenses& senses, const PlanarPose& pose_M, Time now);
  void map_changed() { map_is_new_ = true; }
  /// Time has gone back to `now`.
  void rewind(Time now);
  void clear();

  /// Not before begin() has found a way, nor after clear().
  [[nodiscard]] PathPursuit& pursuit() { return *pursuit_; }
  [[nodiscard]] const PathPursuit& pursuit() const { return *pursuit_; }
  /// From where it was planned to the goal [m, map].
  [[nodiscard]] const std::vector<Eigen::Vector2d>& way() const { return way_; }
  /// Where something not on the map stood in the way last.
  [[nodiscard]] const std::optional<Eigen::Vector2d>& block_M() const { return block_M_; }
  /// Why the last plan failed; "" if it did not.
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
