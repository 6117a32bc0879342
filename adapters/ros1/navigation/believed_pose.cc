// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include "adapters/ros1/navigation/believed_pose.h"

#include <fmt/format.h>

#include "adapters/ros1/navigation/navigation_messages.h"

namespace tagfield {

std::optional<PlanarPose> BelievedPose::odom_on_map() const {
  const std::optional<RigidTransform> X_MO = frames_.newest(names_.map, names_.odom);
  const std::optional<Time> stamp = frames_.newest_stamp(names_.map, names_.odom);
  const std::optional<Time> odometry = frames_.newest_stamp(names_.odom, names_.base);
  if (!X_MO || !stamp || !odometry) return std::nullopt;
  // A frame that never changes is never old.
  const bool is_old = *stamp != Time{} && to_seconds(*odometry - *stamp) > max_age_s_;
  if (is_old) return std::nullopt;
  return to_planar(*X_MO);
}

std::optional<PlanarPose> BelievedPose::odometry() const {
  const std::optional<RigidTransform> X_OR = frames_.newest(names_.odom, names_.base);
  if (!X_OR) return std::nullopt;
  return to_planar(*X_OR);
}

std::optional<PlanarPose> BelievedPose::at(const PlanarPose& odometry) const {
  const std::optional<PlanarPose> q_MO = odom_on_map();
  if (!q_MO) return std::nullopt;
  return to_planar(to_transform(*q_MO) * to_transform(odometry));
}

std::optional<PlanarPose> BelievedPose::now() const {
  const std::optional<PlanarPose> q_OR = odometry();
  return q_OR ? at(*q_OR) : std::nullopt;
}

std::string BelievedPose::trouble() const {
  std::string why = frames_.trouble(names_.odom, names_.base);
  if (why.empty()) why = frames_.trouble(names_.map, names_.odom);
  if (why.empty()) why = fmt::format("'{}' in '{}' is too old", names_.odom, names_.map);
  return why;
}

}  // namespace tagfield
