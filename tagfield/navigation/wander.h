// SPDX-License-Identifier: Apache-2.0
/// @file
/// Wandering without a known pose: what a robot does to see more of the world and localize itself
/// on its map.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "tagfield/navigation/goal_driver.h"

namespace tagfield {

/// How far a disc of radius `half_width_m` at the origin of frame R can move straight towards
/// `angle_rad` before it hits one of `points_R` [m], at most `max_m`. Points that it already
/// covers don't count.
double free_distance(const std::vector<Eigen::Vector2d>& points_R, double angle_rad,
                     double half_width_m, double max_m);

/// A full turn, then short drives towards open space, preferring directions ahead and areas not yet
/// visited; another turn if there is no space. A GoalDriver keeps the robot clear of what its laser
/// sees: this needs no map, and no pose other than the odometry's. Frame O is the odometry frame.
/// The same calls give the same motion.
class Wander {
 public:
  /// Throws Error as GoalDriver does.
  Wander(const GoalDriverSettings& settings, const RigidTransform& X_RL);

  /// Begins with a turn and forgets what was seen, since the robot may have been carried.
  void begin();
  /// Adds a laser scan; `pose_O` is the robot's pose at its timestamp. Ignored if the pose is not
  /// finite.
  void see(const LaserScan& scan, const PlanarPose& pose_O);
  /// Sets points where there may be obstacles that the laser does not see, for the directions
  /// chosen from now on until the next call. All are ignored if the robot itself stands on one of
  /// them.
  void mind(std::vector<Eigen::Vector2d> hidden_O) { hidden_O_ = std::move(hidden_O); }
  /// The velocity to drive from `now` until the next call: zero without a scan from the last half
  /// second, or if the pose is not finite. `velocity` is the robot's current one.
  BodyVelocity next(const PlanarPose& pose_O, const BodyVelocity& velocity, Time now);

 private:
  /// The free distance in a direction of O, as seen from a position.
  struct Room {
    double way_m = 0.0;
    Eigen::Vector2d from_O = Eigen::Vector2d::Zero();
  };

  void doubt_hidden(const Eigen::Vector2d& here_O);
  void choose(const PlanarPose& pose_O, Time now);
  void go(const PlanarPose& goal_O, const PlanarPose& pose_O, bool is_turn, Time now);
  [[nodiscard]] double way_towards(std::size_t sector, const Eigen::Vector2d& here_O) const;
  [[nodiscard]] double gain(std::size_t sector, double way_m, const PlanarPose& pose_O) const;

  RigidTransform X_RL_;
  double radius_m_;
  double half_width_m_;
  GoalDriver driver_;
  std::vector<Room> rooms_;  ///< In equally spaced directions, the first along the x axis of O.
  std::vector<Eigen::Vector2d> ends_O_;  ///< Endpoints of the last scan's beams.
  std::vector<Eigen::Vector2d> hidden_O_;
  std::deque<Eigen::Vector2d> crumbs_O_;  ///< Positions where it has been or could not go.
  bool has_seen_ = false;
  Eigen::Vector2d goal_O_ = Eigen::Vector2d::Zero();
  int turns_left_ = 0;  ///< Thirds of a turn.
  std::optional<Time> chosen_;
};

}  // namespace tagfield
