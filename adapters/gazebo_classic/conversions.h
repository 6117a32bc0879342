/// @file
/// Gazebo's poses and times as Tagfield's.
#pragma once

#include <gazebo/common/Time.hh>
#include <ignition/math/Pose3.hh>

#include "tagfield/base/time.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

inline Time from_gazebo(const gazebo::common::Time& time) {
  return Time(std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nsec));
}

/// The pose of Gazebo's link or sensor; both mean p_A = X_AB * p_B.
inline RigidTransform from_gazebo(const ignition::math::Pose3d& pose) {
  return {Eigen::Quaterniond(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()),
          Eigen::Vector3d(pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z())};
}

}  // namespace tagfield
