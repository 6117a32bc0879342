// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include "adapters/ros1/navigation/frame_listener.h"

#include <tf2/exceptions.h>

#include "adapters/ros1/navigation/navigation_messages.h"

namespace tagfield {
namespace {

constexpr std::uint32_t kFrameQueue = 1000;
/// Stamps this far in the future are left over from before time went back [s].
constexpr double kFarAhead = 5.0;

}  // namespace

FrameListener::FrameListener(ros::NodeHandle& node, std::function<void()> on_change)
    : on_change_(std::move(on_change)) {
  using Message = tf2_msgs::TFMessage;
  const auto changing = [this](const boost::shared_ptr<const Message>& m) { take(*m, false); };
  const auto fixed = [this](const boost::shared_ptr<const Message>& m) { take(*m, true); };
  changing_ = node.subscribe<Message>("/tf", kFrameQueue, changing);
  fixed_ = node.subscribe<Message>("/tf_static", kFrameQueue, fixed);
}

void FrameListener::take(const tf2_msgs::TFMessage& message, bool is_static) {
  const ros::Time latest = ros::Time::now() + ros::Duration(kFarAhead);
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    if (!is_static && transform.header.stamp > latest) continue;
    // Rejects transforms that are not finite, have no name or form a loop, with a message.
    buffer_.setTransform(transform, "tf", is_static);
  }
  on_change_();
}

std::optional<RigidTransform> FrameListener::find(const std::string& F, const std::string& B,
                                                  Time stamp) const {
  try {
    return transform_of(buffer_.lookupTransform(F, B, ros_time(stamp)).transform);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<RigidTransform> FrameListener::newest(const std::string& F,
                                                    const std::string& B) const {
  return find(F, B, Time{});
}

std::optional<Time> FrameListener::newest_stamp(const std::string& F, const std::string& B) const {
  try {
    return time_of(buffer_.lookupTransform(F, B, ros::Time(0)).header.stamp);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

std::string FrameListener::trouble(const std::string& F, const std::string& B) const {
  try {
    transform_of(buffer_.lookupTransform(F, B, ros::Time(0)).transform);
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

MapFrameTeller::MapFrameTeller(ros::NodeHandle& node, FrameNames names)
    : names_(std::move(names)),
      publisher_(node.advertise<tf2_msgs::TFMessage>("/tf", kFrameQueue)) {}

void MapFrameTeller::tell(const PlanarPose& pose_M, const PlanarPose& odometry, Time stamp) {
  // X_MO = X_MR X_RO.
  const RigidTransform X_MO = to_transform(pose_M) * to_transform(odometry).inverse();
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros_time(stamp);
  transform.header.frame_id = names_.map;
  transform.child_frame_id = names_.odom;
  transform.transform = transform_message(X_MO);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  publisher_.publish(message);
}

}  // namespace tagfield
