// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/internal/bodies.h"

#include "tagfield/base/trigonometry.h"

namespace tagfield {
namespace {

MovingBody body_of(const ObstacleSpec& obstacle, Time stamp) {
  MovingBody body{obstacle.name, obstacle.body->material, held_position_at(obstacle.motion, stamp)};
  body.is_round = obstacle.radius_m > 0.0;
  const Eigen::Vector2d half = body.is_round ? Eigen::Vector2d::Constant(obstacle.radius_m)
                                             : Eigen::Vector2d(0.5 * obstacle.size_m);
  body.half_m = {half.x(), half.y(), 0.5 * obstacle.body->height_m};
  body.p_W.z() = body.half_m.z();
  body.yaw_rad = obstacle.yaw_rad;
  return body;
}

}  // namespace

MovingBody body_of(const std::string& robot, const RobotBody& body, const RigidTransform& X_WB) {
  const Eigen::Vector3d ahead = X_WB.rotation * Eigen::Vector3d::UnitX();
  MovingBody moving{robot, body.material, X_WB.translation, 0.5 * body.size_m};
  moving.p_W.z() += moving.half_m.z();
  moving.yaw_rad = arc_tangent(ahead.y(), ahead.x());
  return moving;
}

std::vector<MovingBody> bodies_of(const std::vector<ObstacleSpec>& obstacles, Time stamp) {
  std::vector<MovingBody> bodies;
  for (const ObstacleSpec& obstacle : obstacles) {
    if (obstacle.body && is_there(obstacle, stamp)) bodies.push_back(body_of(obstacle, stamp));
  }
  return bodies;
}

}  // namespace tagfield
