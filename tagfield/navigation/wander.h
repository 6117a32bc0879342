// SPDX-License-Identifier: Apache-2.0
/// @file
/// Moving about without knowing where: what a robot does that must see more of the world to find
/// itself on its map.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "tagfield/navigation/goal_driver.h"

namespace tagfield {

/// How far a disc of radius `half_width_m` about the origin of `points_R` can go straight on
/// towards `angle_rad` before it meets one of them [m], at most `most_m`. Points that it covers
/// already don't count.
double open_way(const std::vector<Eigen::Vector2d>& points_R, double angle_rad, double half_width_m,
                double most_m);

/// A full turn, then short ways towards open room, rather ahead than back and rather to where it
/// has not been; another turn where there is no room. A GoalDriver keeps it clear of what its laser
/// sees: it needs no map, and no pose but the wheels'. Frame O is the odometry's. The same calls
/// give the same motion.
class Wander {
 public:
  /// Throws Error as GoalDriver does.
  Wander(const GoalDriverSettings& settings, const RigidTransform& X_RL);

  /// Begins with a turn, and forgets what was seen: the robot may have been carried.
  void begin();
  /// What the laser saw; `pose_O` is the robot's at the scan's stamp. A pose that is not finite is
  /// passed over.
  void see(const LaserScan& scan, const PlanarPose& pose_O);
  /// Where there may be something that the laser does not see; counts for the ways that are chosen
  /// from now on, until the next call. Not heeded where the robot itself stands on it.
  void mind(std::vector<Eigen::Vector2d> hidden_O) { hidden_O_ = std::move(hidden_O); }
  /// What to drive from `now` until the next call: nothing without a scan of the last half second,
  /// or where the pose is not finite. `velocity` is the robot's present one.
  BodyVelocity next(const PlanarPose& pose_O, const BodyVelocity& velocity, Time now);

 private:
  /// How far it is open in a direction of O, as seen from a place.
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
  std::vector<Room> rooms_;              ///< In directions at equal angles, the first along O's x.
  std::vector<Eigen::Vector2d> ends_O_;  ///< Of the last scan's beams.
  std::vector<Eigen::Vector2d> hidden_O_;
  std::deque<Eigen::Vector2d> crumbs_O_;  ///< Where it has been, and where it could not go.
  bool has_seen_ = false;
  Eigen::Vector2d goal_O_ = Eigen::Vector2d::Zero();
  int turns_left_ = 0;  ///< Thirds of a turn.
  std::optional<Time> chosen_;
};

}  // namespace tagfield
