// SPDX-License-Identifier: Apache-2.0
/// @file
/// A simulated robot that navigates by itself: it localizes itself by laser, odometry and a map,
/// and drives to goals.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/navigation/goal_driver.h"
#include "tagfield/navigation/monte_carlo_localizer.h"
#include "tagfield/navigation/wander.h"
#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/robot_senses.h"

namespace tagfield {

/// The outcome of a goal.
struct GoalOutcome {
  PlanarPose goal_M;
  DriveState state = DriveState::kIdle;
  std::string reason;    ///< If it was not reached.
  PlanarPose truth_W;    ///< True pose of the robot at the end.
  double seconds = 0.0;  ///< Since the goal was given.
};

/// While the robot does not know its pose, it wanders using its laser, and its goal has to wait.
/// After kSearchLimit_s of wandering it gives all goals up. If its scans don't fit the map when a
/// goal ends, reached or not, it starts a new global localization.
class SelfDriver {
 public:
  static constexpr double kSearchLimit_s = 300.0;

  /// Drives to `goals_M` one after another, at `speed_m_s`. Without a `start` it may be anywhere on
  /// the map. `walls`: as for MonteCarloLocalizer.
  SelfDriver(const NavigationSpec& navigation, double speed_m_s, const NavigationWorld& world,
             const OccupancyGrid& map, const HitGrid* walls,
             const std::optional<PoseEstimate>& start, const std::vector<PlanarPose>& goals_M,
             std::uint64_t seed, std::uint64_t key);

  /// Decides the velocity for the step that begins at `now` with the robot at `begin_W`, and
  /// simulates the sensors in that step.
  BodyVelocity step(const PlanarPose& begin_W, Time now, double seconds);

  /// Believed pose `seconds` after the beginning of the current step.
  [[nodiscard]] PoseEstimate believed(double seconds) const;
  /// Scans that ended in the current step, and the believed poses at their timestamps.
  [[nodiscard]] const std::vector<SensedScan>& scans() const { return scans_; }
  [[nodiscard]] PlanarPose believed_at(const SensedScan& sensed) const;
  /// Whether the robot believes that it knows its pose.
  [[nodiscard]] bool knows_position() const { return knows_position_; }
  /// Whether all goals are reached or given up.
  [[nodiscard]] bool finished() const { return outcomes_.size() == goals_.size(); }
  /// Share of the goals that are done; 1 if there are none.
  [[nodiscard]] double progress() const;
  [[nodiscard]] const std::vector<GoalOutcome>& outcomes() const { return outcomes_; }
  [[nodiscard]] const MonteCarloLocalizer& localizer() const { return localizer_; }

 private:
  void look_after_place(Time now);
  bool doubts_place();
  void look_after_goals(const PlanarPose& begin_W, const PlanarPose& pose_M, Time now);
  void end_goal(DriveState state, const std::string& reason, const PlanarPose& begin_W, Time now);
  BodyVelocity wanted(const PlanarPose& begin_W, Time now);

  [[nodiscard]] std::vector<Eigen::Vector2d> hidden_things(const PlanarPose& odometry) const;

  GoalDriverSettings settings_;
  RobotSenses senses_;
  MonteCarloLocalizer localizer_;
  GoalDriver driver_;
  Wander wander_;
  std::vector<PlanarPose> goals_;
  std::vector<GoalOutcome> outcomes_;
  BodyVelocity velocity_;
  std::vector<SensedScan> scans_;
  std::vector<Eigen::Vector2d> hidden_M_;  ///< Occupied cells that the laser does not see.
  bool knows_position_ = true;
  Time lost_since_;
  bool is_under_way_ = false;  ///< The driver has the current goal.
  std::optional<Time> goal_given_;
  bool has_looked_ = false;   ///< A scan has been matched to the map.
  bool has_doubted_ = false;  ///< For the current goal.
};

/// Goals at the waypoints, each heading along the path segment that leads to it.
std::vector<PlanarPose> goals_at(const PlanarPose& start,
                                 const std::vector<Eigen::Vector2d>& waypoints);

}  // namespace tagfield
