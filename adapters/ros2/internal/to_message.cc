// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/internal/to_message.h"

#include <chrono>

namespace tagfield::ros2 {
namespace {

geometry_msgs::Quaternion rotation_message(const Eigen::Quaterniond& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

}  // namespace

builtin_interfaces::Time to_message(Time stamp) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(stamp.time_since_epoch());
  return {static_cast<std::int32_t>(seconds.count()),
          static_cast<std::uint32_t>((stamp.time_since_epoch() - seconds).count())};
}

geometry_msgs::Point point_message(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

geometry_msgs::Vector3 vector_message(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

geometry_msgs::Pose pose_message(const RigidTransform& X) {
  return {point_message(X.translation), rotation_message(X.rotation)};
}

std_msgs::Header header_message(Time stamp, const std::string& frame) {
  return {to_message(stamp), frame};
}

geometry_msgs::TransformStamped frame_message(Time stamp, const std::string& parent,
                                              const std::string& child, const RigidTransform& X) {
  return {header_message(stamp, parent),
          child,
          {vector_message(X.translation), rotation_message(X.rotation)}};
}

}  // namespace tagfield::ros2
