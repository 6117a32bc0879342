// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/robot_topics.h"

#include <array>
#include <sstream>
#include <utility>

#include "adapters/ros2/internal/to_message.h"
#include "adapters/ros2/ros2_outlet.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield::ros2 {
namespace {

/// Variance of what wheels on a floor don't measure: height, roll, pitch.
constexpr double kFloorVariance = 1e-6;

/// "a/b", "odom" → "/a/b/odom"
std::string topic_in(const std::string& name_space, const std::string& name) {
  std::string topic = "/";
  std::istringstream tokens(name_space);
  for (std::string token; std::getline(tokens, token, '/');) {
    if (!token.empty()) topic.append(topic_token(token)).append("/");
  }
  return topic.append(name);
}

/// Rows and columns are x, y, z, roll, pitch, yaw; wheels tell of x, y and yaw.
std::array<double, 36> pose_covariance(const Eigen::Matrix3d& planar) {
  constexpr std::array<std::size_t, 3> kAxes = {0, 1, 5};
  std::array<double, 36> covariance{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      covariance.at(6 * kAxes.at(row) + kAxes.at(column)) =
          planar(static_cast<int>(row), static_cast<int>(column));
    }
  }
  for (const std::size_t axis : {2U, 3U, 4U}) covariance.at(7 * axis) = kFloorVariance;
  return covariance;
}

std::array<double, 36> twist_covariance(const Eigen::Vector2d& variance) {
  std::array<double, 36> covariance{};
  covariance[0] = variance.x();
  for (const std::size_t axis : {1U, 2U, 3U, 4U}) covariance.at(7 * axis) = kFloorVariance;
  covariance[35] = variance.y();
  return covariance;
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
  const RigidTransform X_OB = to_transform(odometry.pose);
  nav_msgs::Odometry message;
  message.header = header_message(odometry.stamp, names_.odom);
  message.child_frame_id = names_.base;
  message.pose = {pose_message(X_OB), pose_covariance(odometry.covariance)};
  message.twist.twist.linear.x = odometry.velocity.forward;
  message.twist.twist.angular.z = odometry.velocity.turn;
  message.twist.covariance = twist_covariance(odometry.velocity_variance);
  odometry_.publish(odometry.stamp, message);
  if (!names_.publish_tf) return;
  tf_.publish(odometry.stamp, {{frame_message(odometry.stamp, names_.odom, names_.base, X_OB)}});
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
  message.range_min = static_cast<float>(scan.least_range_m);
  message.range_max = static_cast<float>(scan.most_range_m);
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
