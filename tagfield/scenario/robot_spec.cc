// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/robot_spec.h"

#include "tagfield/motion/planar_pose.h"

namespace tagfield {

double planned_length(const RobotSpec& robot) {
  double length = 0.0;
  Eigen::Vector2d at = position_of(robot.start);
  const auto go_on = [&](const Eigen::Vector2d& next) {
    length += (next - at).norm();
    at = next;
  };
  for (const Eigen::Vector2d& waypoint : robot.waypoints) go_on(waypoint);
  for (const PlanarPose& goal : robot.goals_W) go_on(position_of(goal));
  return length;
}

}  // namespace tagfield
