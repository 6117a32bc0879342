// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/robot_topics.h"

#include <sstream>
#include <utility>

#include "adapters/ros2/internal/to_message.h"
#include "adapters/ros2/ros2_outlet.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield::ros2 {
namespace {

/// "a/b", "odom" → "/a/b/odom"
std::string topic_in(const std::string& name_space, const std::string& name) {
  std::string topic = "/";
  std::istringstream tokens(name_space);
  for (std::string token; std::getline(tokens, token, '/');) {
    if (!token.empty()) topic.append(topic_token(token)).append("/");
  }
  return topic.append(name);
}

}  // namespace

RobotTopics::RobotTopics(std::shared_ptr<MessageSink> sink, RobotNames names)
    : sink_(std::move(sink)),
      names_(std::move(names)),
      odometry_(*sink_, {topic_in(names_.name_space, "odom")}),
      truth_(*sink_, {topic_in(names_.name_space, "ground_truth/odom")}),
      scans_(*sink_, {topic_in(names_.name_space, "scan"), Delivery::kBestEffort}),
      tf_(*sink_, {"/tf"}),
      static_tf_(*sink_, {"/tf_static", Delivery::kLatched}) {}

void RobotTopics::publish(const OdometryReport& odometry) const {
  odometry_.publish(odometry.stamp, odometry_message(odometry, names_));
  if (!names_.publish_tf) return;
  tf_.publish(
      odometry.stamp,
      {{frame_message(odometry.stamp, names_.odom, names_.base, to_transform(odometry.pose))}});
}

void RobotTopics::publish(const MotionReport& motion) const {
  nav_msgs::Odometry message;
  message.header = header_message(motion.stamp, kMapFrame);
  message.child_frame_id = names_.base;
  message.pose.pose = pose_message(motion.X_WB);
  message.twist.twist = {vector_message(motion.linear_B), vector_message(motion.angular_B)};
  truth_.publish(motion.stamp, message);
}

void RobotTopics::publish(const ScanReport& scan) const {
  const auto steps = static_cast<double>(scan.ranges_m.size()) - 1.0;
  const double turn_rad = scan.last_angle_rad - scan.first_angle_rad;
  sensor_msgs::LaserScan message;
  message.header = header_message(scan.stamp, names_.laser);
  message.angle_min = static_cast<float>(scan.first_angle_rad);
  message.angle_max = static_cast<float>(scan.last_angle_rad);
  message.angle_increment = static_cast<float>(steps > 0.0 ? turn_rad / steps : 0.0);
  message.scan_time = static_cast<float>(scan.interval_s);
  message.range_min = static_cast<float>(scan.min_range_m);
  message.range_max = static_cast<float>(scan.max_range_m);
  message.ranges = scan.ranges_m;
  scans_.publish(scan.stamp, message);
}

void RobotTopics::publish_fixed_frames(Time now, const std::optional<RigidTransform>& X_BL,
                                       const RigidTransform& X_WO) const {
  tf2_msgs::TFMessage frames;
  if (X_BL) frames.transforms.push_back(frame_message(now, names_.base, names_.laser, *X_BL));
  if (!names_.odom_parent.empty()) {
    frames.transforms.push_back(
        frame_message(now, frame_in_ros2(names_.odom_parent), names_.odom, X_WO));
  }
  if (names_.publish_tf && !frames.transforms.empty()) static_tf_.publish(now, frames);
}

}  // namespace tagfield::ros2
