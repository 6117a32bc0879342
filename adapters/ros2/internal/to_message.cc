// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/internal/to_message.h"

#include <array>
#include <chrono>

namespace tagfield::ros2 {
namespace {

/// Variance of the quantities that odometry on a floor does not measure: height, roll, pitch.
constexpr double kFloorVariance = 1e-6;

geometry_msgs::Quaternion rotation_message(const Eigen::Quaterniond& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

/// Rows and columns are x, y, z, roll, pitch, yaw; odometry measures x, y and yaw.
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

nav_msgs::Odometry odometry_message(const OdometryReport& report, const RobotNames& names) {
  nav_msgs::Odometry message;
  message.header = header_message(report.stamp, names.odom);
  message.child_frame_id = names.base;
  message.pose = {pose_message(to_transform(report.pose)), pose_covariance(report.covariance)};
  message.twist.twist.linear.x = report.velocity.forward;
  message.twist.twist.angular.z = report.velocity.turn;
  message.twist.covariance = twist_covariance(report.velocity_variance);
  return message;
}

}  // namespace tagfield::ros2
