// SPDX-License-Identifier: Apache-2.0
/// @file
/// Rigid transforms. `X_AB` is the pose of frame B in frame A: p_A = X_AB * p_B. `p_AB` is the
/// position of B's origin in A. W is the world: right-handed, z up, metres (REP-103).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

namespace tagfield {

/// A rotation (unit quaternion) and a translation [m].
struct RigidTransform {
  Eigen::Quaterniond rotation{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z.
  Eigen::Vector3d translation{0.0, 0.0, 0.0};

  /// X_AC = X_AB * X_BC.
  RigidTransform operator*(const RigidTransform& X_BC) const;
  /// p_A = X_AB * p_B.
  Eigen::Vector3d operator*(const Eigen::Vector3d& p_B) const;
  /// X_BA of X_AB.
  [[nodiscard]] RigidTransform inverse() const;
};

bool is_finite(const RigidTransform& X);

/// `quaternion` as a rotation: unchanged if its norm is 1 within 1e-9, so that written values are
/// restored exactly; normalized if the norm is 0.9 to 1.1; otherwise none.
std::optional<Eigen::Quaterniond> as_rotation(const Eigen::Quaterniond& quaternion);

/// A pure translation [m].
RigidTransform from_translation(const Eigen::Vector3d& translation);

/// Position [m] and roll, pitch, yaw [rad] about the fixed x, y, z axes in this order, as in SDF's
/// `<pose>` and URDF's `rpy`: R = Rz(yaw) Ry(pitch) Rx(roll).
RigidTransform from_xyz_rpy(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy);

/// A pose in the plane z = 0: (x, y) [m] and yaw [rad].
RigidTransform from_planar(double x, double y, double yaw);

/// Rotates vectors in the plane counterclockwise by an angle [rad].
Eigen::Matrix2d rotation_in_plane(double angle_rad);

/// Heading about z [rad], in [-π, π].
double yaw_of(const Eigen::Quaterniond& rotation);

/// Interpolates from `from` (fraction 0) to `to` (fraction 1): positions linearly, rotations along
/// the shorter great arc (slerp).
RigidTransform interpolate(const RigidTransform& from, const RigidTransform& to, double fraction);

}  // namespace tagfield
