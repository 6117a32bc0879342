// SPDX-License-Identifier: Apache-2.0
/// @file
/// Gazebo's poses as Tagfield's.
#pragma once

#include "adapters/gazebo_common/gz_names.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

inline Eigen::Vector3d from_gazebo(const gz_math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

/// The pose of a Gazebo link or sensor; in both conventions p_A = X_AB * p_B.
inline RigidTransform from_gazebo(const gz_math::Pose3d& pose) {
  return {Eigen::Quaterniond(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()),
          from_gazebo(pose.Pos())};
}

/// Exact comparison; Gazebo's own considers poses a millimetre apart equal.
inline bool is_same(const gz_math::Pose3d& a, const gz_math::Pose3d& b) {
  return a.Pos().X() == b.Pos().X() && a.Pos().Y() == b.Pos().Y() && a.Pos().Z() == b.Pos().Z() &&
         a.Rot().W() == b.Rot().W() && a.Rot().X() == b.Rot().X() && a.Rot().Y() == b.Rot().Y() &&
         a.Rot().Z() == b.Rot().Z();
}

}  // namespace tagfield
