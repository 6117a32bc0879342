// SPDX-License-Identifier: Apache-2.0
/// @file
/// Composition of poses in the floor plane.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// q_AC from q_AB and q_BC.
inline PlanarPose compose(const PlanarPose& q_AB, const PlanarPose& q_BC) {
  const auto [s, c] = sine_cosine(q_AB.yaw);
  return {q_AB.x + c * q_BC.x - s * q_BC.y, q_AB.y + s * q_BC.x + c * q_BC.y, q_AB.yaw + q_BC.yaw};
}

/// q_BC from q_AB and q_AC: the pose of C relative to B. Its yaw is in [-π, π).
inline PlanarPose between(const PlanarPose& q_AB, const PlanarPose& q_AC) {
  const auto [s, c] = sine_cosine(q_AB.yaw);
  const double dx = q_AC.x - q_AB.x;
  const double dy = q_AC.y - q_AB.y;
  return {c * dx + s * dy, -s * dx + c * dy, wrap_to_pi(q_AC.yaw - q_AB.yaw)};
}

/// p_A from p_B.
inline Eigen::Vector2d transformed(const PlanarPose& q_AB, const Eigen::Vector2d& p_B) {
  const auto [s, c] = sine_cosine(q_AB.yaw);
  return {q_AB.x + c * p_B.x() - s * p_B.y(), q_AB.y + s * p_B.x() + c * p_B.y()};
}

inline bool is_finite(const PlanarPose& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
}

/// Projection of a pose in space onto the floor plane: its position and heading seen from above.
inline PlanarPose planar(const RigidTransform& X_AB) {
  return {X_AB.translation.x(), X_AB.translation.y(), yaw_of(X_AB.rotation)};
}

/// The pose's position on the floor.
inline Eigen::Vector2d position_of(const PlanarPose& pose) { return {pose.x, pose.y}; }

}  // namespace tagfield
