// SPDX-License-Identifier: Apache-2.0
/// @file
/// All that a driving robot knows about its surroundings: the map, what its laser saw, where it has
/// been.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/navigation/local_planner.h"
#include "tagfield/navigation/moving_obstacles.h"
#include "tagfield/navigation/scan_memory.h"

namespace tagfield {

class DriveSenses {
 public:
  /// `radius_m` is the radius of the robot's footprint.
  DriveSenses(const RigidTransform& X_RL, double radius_m) : X_RL_(X_RL), radius_m_(radius_m) {}

  /// Throws Error on a map that is empty or malformed.
  void set_map(const OccupancyGrid& map);
  [[nodiscard]] const OccupancyGrid& map() const { return map_; }

  /// Adds a scan. A scan older than the last one discards all that was seen before.
  void see(const LaserScan& scan, const PlanarPose& pose_M);
  /// Sets the robot's current pose and velocity.
  void be_at(const PlanarPose& pose_M, const BodyVelocity& velocity);
  /// Forgets everything except the map.
  void forget();

  /// Why there is no usable scan at `now`, in words; "" if there is one.
  [[nodiscard]] std::string blindness(Time now) const;
  /// The static obstacles around `pose_M`.
  [[nodiscard]] DistanceWindow window(const PlanarPose& pose_M, double half_m, double max_m) const;
  /// What rollouts from `pose_M` must keep clear of; refers to `window` and to this.
  [[nodiscard]] Surroundings surroundings(const DistanceWindow& window, const PlanarPose& pose_M,
                                          Time now) const;
  /// Points of static obstacles that are not on the map.
  [[nodiscard]] std::vector<Eigen::Vector2d> not_on_map() const { return memory_.not_on_map(); }
  /// Distance from `p_M` to the centre of the nearest occupied cell, at most kMaxToMap [m].
  [[nodiscard]] double distance_to_map(const Eigen::Vector2d& p_M) const;

  static constexpr double kMaxToMap = 1.0;

 private:
  /// distance_to_map() of any point of a cell.
  [[nodiscard]] double distance_of_cell(const Eigen::Vector2i& cell) const;
  [[nodiscard]] bool is_known_free(const Eigen::Vector2d& p_M) const;
  [[nodiscard]] std::vector<Eigen::Vector2d> points_around(const Eigen::Vector2d& p_M,
                                                           double reach_m) const;
  [[nodiscard]] double clear_at(const Eigen::Vector2d& p_M) const;

  RigidTransform X_RL_;
  double radius_m_;
  OccupancyGrid map_;
  std::vector<float> to_occupied_;
  ScanMemory memory_;
  ObstacleTracker tracker_;
  std::optional<Time> last_scan_;
  double valid_share_ = 0.0;
  std::vector<Eigen::Vector2d> may_be_M_;
  BodyVelocity velocity_;
  std::deque<Eigen::Vector2d> trail_M_;
};

}  // namespace tagfield
