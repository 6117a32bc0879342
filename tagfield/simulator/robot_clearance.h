// SPDX-License-Identifier: Apache-2.0
/// @file
/// The clearance of a robot from what is in the world.
#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "tagfield/laser/simulated_laser.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// Height that a P3-AT's wheels roll over [m]; anything lower is floor, or its unevenness.
inline constexpr double kRolledOver = 0.06;

/// A robot seen from above: a rectangle centred on its base, x forward. The default is a P3-AT with
/// its wheels.
struct RobotOutline {
  double length_m = 0.51;
  double width_m = 0.50;
  double height_m = 0.36;
};

/// Distance between the robot's outline at the origin, x forward, and the line segment from `a` to
/// `b` [m]; 0 if they touch.
double distance_to_line(const RobotOutline& outline, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b);

/// The world's solids between the floor and the robot's height, seen from above.
class RobotClearance {
 public:
  /// Upper limits of distance() and room_at() [m].
  static constexpr double kMost = 1.0;
  static constexpr double kMaxRoom = 10.0;

  RobotClearance(const Scene& scene, const RobotOutline& outline);

  /// Minimum distance between the robot's outline and a solid or an obstacle [m], 0 if they touch
  /// or the robot is inside an obstacle. Solids are as in top_view(), to 1 mm; those taller than
  /// the robot are hollow, as a hall is.
  [[nodiscard]] double distance(const PlanarPose& pose_W, const Obstacles& obstacles) const;

  /// Minimum distance between the outlines of two robots [m], at most kMost.
  [[nodiscard]] double distance_between(const PlanarPose& one_W, const PlanarPose& other_W) const;

  /// Minimum distance from a point to a solid [m], underestimated by up to 6 cm and never
  /// overestimated; 10 m if all solids are farther, 2 m outside the area around the solids.
  [[nodiscard]] double room_at(const Eigen::Vector2d& p_W) const;

 private:
  using Edge = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

  void add_edge(const Edge& edge);
  [[nodiscard]] double distance_to_solids(const PlanarPose& pose_W) const;

  RobotOutline outline_;
  double reach_m_;  ///< From the robot's base to anything closer than kMost.
  OccupancyGrid grid_;
  std::vector<float> distances_;
  std::map<std::pair<int, int>, std::vector<Edge>> edges_;  ///< By square metre within reach.
};

}  // namespace tagfield
