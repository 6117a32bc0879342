// SPDX-License-Identifier: Apache-2.0
#include "tagfield/poses/rigid_transform.h"

#include <cmath>

#include "tagfield/base/trigonometry.h"

namespace tagfield {
namespace {

Eigen::Quaterniond turned_about(const Eigen::Vector3d& axis, double angle_rad) {
  const auto [s, c] = sine_cosine(0.5 * angle_rad);
  return {c, s * axis.x(), s * axis.y(), s * axis.z()};
}

/// Spherical interpolation of quaternions along the shorter arc.
Eigen::Quaterniond on_great_arc(const Eigen::Quaterniond& from, Eigen::Quaterniond to,
                                double fraction) {
  if (from.dot(to) < 0.0) to.coeffs() = -to.coeffs();
  const double angle =
      2.0 * arc_tangent((to.coeffs() - from.coeffs()).norm(), (to.coeffs() + from.coeffs()).norm());
  const double whole = sine(angle);
  // For nearly equal rotations, the arc is its chord.
  if (!(whole > 1e-9)) {
    return Eigen::Quaterniond(from.coeffs() + fraction * (to.coeffs() - from.coeffs()));
  }
  return Eigen::Quaterniond(
      (sine((1.0 - fraction) * angle) * from.coeffs() + sine(fraction * angle) * to.coeffs()) /
      whole);
}

}  // namespace

RigidTransform RigidTransform::operator*(const RigidTransform& X_BC) const {
  return {(rotation * X_BC.rotation).normalized(), rotation * X_BC.translation + translation};
}

Eigen::Vector3d RigidTransform::operator*(const Eigen::Vector3d& p_B) const {
  return rotation * p_B + translation;
}

RigidTransform RigidTransform::inverse() const {
  const Eigen::Quaterniond inverse_rotation = rotation.conjugate();
  return {inverse_rotation, -(inverse_rotation * translation)};
}

bool is_finite(const RigidTransform& X) {
  return X.translation.allFinite() && X.rotation.coeffs().allFinite();
}

std::optional<Eigen::Quaterniond> as_rotation(const Eigen::Quaterniond& quaternion) {
  const double length_error = std::abs(quaternion.norm() - 1.0);
  if (length_error <= 1e-9) return quaternion;
  if (!(length_error <= 0.1)) return std::nullopt;
  return quaternion.normalized();
}

RigidTransform from_translation(const Eigen::Vector3d& translation) {
  return {Eigen::Quaterniond::Identity(), translation};
}

RigidTransform from_xyz_rpy(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy) {
  const Eigen::Quaterniond rotation = turned_about(Eigen::Vector3d::UnitZ(), rpy.z()) *
                                      turned_about(Eigen::Vector3d::UnitY(), rpy.y()) *
                                      turned_about(Eigen::Vector3d::UnitX(), rpy.x());
  return {rotation.normalized(), xyz};
}

RigidTransform from_planar(double x, double y, double yaw) {
  return {turned_about(Eigen::Vector3d::UnitZ(), yaw), {x, y, 0.0}};
}

Eigen::Matrix2d rotation_in_plane(double angle_rad) {
  const auto [s, c] = sine_cosine(angle_rad);
  Eigen::Matrix2d rotation;
  rotation << c, -s, s, c;
  return rotation;
}

double yaw_of(const Eigen::Quaterniond& rotation) {
  const Eigen::Vector3d forward = rotation * Eigen::Vector3d::UnitX();
  return arc_tangent(forward.y(), forward.x());
}

RigidTransform interpolate(const RigidTransform& from, const RigidTransform& to, double fraction) {
  return {on_great_arc(from.rotation, to.rotation, fraction),
          from.translation + fraction * (to.translation - from.translation)};
}

}  // namespace tagfield
