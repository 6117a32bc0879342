// SPDX-License-Identifier: Apache-2.0
#include "tagfield/poses/rigid_transform.h"

#include <cmath>

namespace tagfield {

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
  const Eigen::Quaterniond rotation = Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX());
  return {rotation.normalized(), xyz};
}

RigidTransform from_planar(double x, double y, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {x, y, 0.0}};
}

double yaw_of(const Eigen::Quaterniond& rotation) {
  const Eigen::Vector3d forward = rotation * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

RigidTransform interpolate(const RigidTransform& from, const RigidTransform& to, double fraction) {
  return {from.rotation.slerp(fraction, to.rotation),
          from.translation + fraction * (to.translation - from.translation)};
}

}  // namespace tagfield
