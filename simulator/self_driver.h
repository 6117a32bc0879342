/// @file
/// A simulated robot that finds its way by itself: it knows its pose from its laser, its wheels and
/// a map, and drives to goals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "navigation/goal_driver.h"
#include "navigation/monte_carlo_localizer.h"
#include "simulator/navigation_spec.h"
#include "simulator/navigation_world.h"
#include "simulator/robot_senses.h"

namespace tagfield {

/// What became of a goal.
struct GoalOutcome {
  PlanarPose goal_M;
  DriveState state = DriveState::kIdle;
  std::string reason;    ///< Where it was not reached.
  PlanarPose truth_W;    ///< Where the robot was at the end.
  double seconds = 0.0;  ///< From when it was given.
};

class SelfDriver {
 public:
  /// Drives to `goals_M` one after another, at `speed_m_s`.
  SelfDriver(const NavigationSpec& navigation, double speed_m_s, const NavigationWorld& world,
             const OccupancyGrid& map, const PoseEstimate& start,
             const std::vector<PlanarPose>& goals_M, std::uint64_t seed, std::uint64_t key);

  /// Decides the velocity for the step that begins at `now` with the robot at `begin_W`, and lets
  /// the robot sense what it senses in that step.
  BodyVelocity step(const PlanarPose& begin_W, Time now, double seconds);

  /// Believed pose `seconds` after the present step's beginning.
  [[nodiscard]] PoseEstimate believed(double seconds) const;
  /// Whether all goals are reached or given up.
  [[nodiscard]] bool finished() const { return outcomes_.size() == goals_.size(); }
  [[nodiscard]] const std::vector<GoalOutcome>& outcomes() const { return outcomes_; }
  [[nodiscard]] MonteCarloLocalizer& localizer() { return localizer_; }
  [[nodiscard]] const MonteCarloLocalizer& localizer() const { return localizer_; }

 private:
  void look_after_goals(const PlanarPose& begin_W, const PlanarPose& pose_M, Time now);

  GoalDriverSettings settings_;
  RobotSenses senses_;
  MonteCarloLocalizer localizer_;
  GoalDriver driver_;
  std::vector<PlanarPose> goals_;
  std::vector<GoalOutcome> outcomes_;
  BodyVelocity velocity_;
  bool has_goal_ = false;
  Time goal_given_;
};

/// Goals at the waypoints, each looking along the way that led there.
std::vector<PlanarPose> goals_at(const PlanarPose& start,
                                 const std::vector<Eigen::Vector2d>& waypoints);

}  // namespace tagfield
