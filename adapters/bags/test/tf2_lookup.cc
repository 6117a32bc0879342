// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/test/tf2_lookup.h"

#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>

namespace tagfield {
namespace {

ros::Time ros_time(Time stamp) {
  ros::Time converted;
  converted.fromNSec(static_cast<std::uint64_t>(stamp.time_since_epoch().count()));
  return converted;
}

geometry_msgs::TransformStamped message_of(const StampedTransform& transform) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = ros_time(transform.stamp);
  message.header.frame_id = transform.parent;
  message.child_frame_id = transform.child;
  message.transform.translation.x = transform.X_PC.translation.x();
  message.transform.translation.y = transform.X_PC.translation.y();
  message.transform.translation.z = transform.X_PC.translation.z();
  message.transform.rotation.x = transform.X_PC.rotation.x();
  message.transform.rotation.y = transform.X_PC.rotation.y();
  message.transform.rotation.z = transform.X_PC.rotation.z();
  message.transform.rotation.w = transform.X_PC.rotation.w();
  return message;
}

}  // namespace

std::optional<RigidTransform> tf2_lookup(const std::vector<StampedTransform>& transforms,
                                         const std::string& F, const std::string& B, Time stamp) {
  tf2::BufferCore buffer(ros::Duration(1000.0));
  for (const StampedTransform& transform : transforms) {
    buffer.setTransform(message_of(transform), "test", transform.is_static);
  }
  try {
    const auto found = buffer.lookupTransform(F, B, ros_time(stamp)).transform;
    const geometry_msgs::Quaternion& q = found.rotation;
    const geometry_msgs::Vector3& p = found.translation;
    return RigidTransform{Eigen::Quaterniond(q.w, q.x, q.y, q.z), {p.x, p.y, p.z}};
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

}  // namespace tagfield
