// SPDX-License-Identifier: Apache-2.0
/// @file
/// Motion as a sequence of timestamped poses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// The pose of some body B in the world at one time.
struct StampedPose {
  Time stamp;
  RigidTransform X_WB;
};

/// The pose of an antenna in the world at one time, true or believed.
struct AntennaPose {
  Time stamp;
  std::string antenna;
  RigidTransform X_WA;
  /// Of a believed pose's x, y, yaw [m², m·rad, rad²], if known.
  std::optional<Eigen::Matrix3d> covariance{};
};

/// Poses in time order.
using Trajectory = std::vector<StampedPose>;

/// Throws Error unless timestamps are strictly increasing.
void require_rising_stamps(const Trajectory& trajectory);

/// Pose at `stamp`, interpolated between the two around it; none before the first or after the
/// last. `max_gap` > 0 refuses to interpolate between two poses further apart in time than that,
/// unless the body moved less than `still_distance` [m] between them. A trajectory of one pose is
/// stationary at all times.
std::optional<RigidTransform> pose_at(const Trajectory& trajectory, Time stamp,
                                      Duration max_gap = Duration::zero(),
                                      double still_distance = 0.0);

/// Pose at `stamp`, holding the first before it and the last after it. The trajectory must not be
/// empty.
RigidTransform held_pose_at(const Trajectory& trajectory, Time stamp);

/// Only the position [m] of held_pose_at(), bit-identical, in a fraction of the time.
Eigen::Vector3d held_position_at(const Trajectory& trajectory, Time stamp);

/// Sum of the distances between consecutive positions [m].
double path_length(const Trajectory& trajectory);

}  // namespace tagfield
