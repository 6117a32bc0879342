// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include "adapters/ros1/navigation/navigation_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tagfield {
namespace {

/// Indices of x, y and yaw in x, y, z, roll, pitch, yaw.
constexpr std::size_t kPlanarRows[] = {0, 1, 5};
constexpr double kMinVariance = 1e-6;
/// Rotations of a map below this count as none [rad].
constexpr double kStraight = 1e-6;
constexpr int kMaxCells = 100'000;  ///< Along one side.

RigidTransform checked_pose(const Eigen::Quaterniond& rotation,
                            const Eigen::Vector3d& translation) {
  if (!translation.allFinite()) throw Error("position is not finite");
  const double norm = rotation.norm();
  if (!(norm > 0.9 && norm < 1.1)) {
    throw Error(fmt::format("orientation has length {}, expected 1", norm));
  }
  return {rotation.normalized(), translation};
}

void check_angles(const sensor_msgs::LaserScan& message) {
  if (!std::isfinite(message.angle_min) || !std::isfinite(message.angle_increment) ||
      !(message.angle_increment > 0.0F)) {
    throw Error(fmt::format("scan: angles from {} by {}, expected finite ones and steps > 0",
                            message.angle_min, message.angle_increment));
  }
  const bool is_timed = message.time_increment >= 0.0F && message.time_increment < 1.0F;
  if (!is_timed) {
    throw Error(fmt::format("scan: time_increment is {}, expected 0 to 1", message.time_increment));
  }
  if (!(message.range_min >= 0.0F && message.range_max > message.range_min)) {
    throw Error(fmt::format("scan: range_min {} and range_max {}, expected 0 <= min < max",
                            message.range_min, message.range_max));
  }
}

/// Beyond range_max there was no return; 0 is invalid.
float range_of(float range, const LaserScan& scan) {
  if (std::isnan(range)) return 0.0F;
  if (range >= static_cast<float>(scan.max_range_m)) return nothing_range(scan.max_range_m);
  return range < static_cast<float>(scan.min_range_m) ? 0.0F : range;
}

void check_size(const nav_msgs::OccupancyGrid& message) {
  const std::uint32_t width = message.info.width;
  const std::uint32_t height = message.info.height;
  if (width == 0 || height == 0) throw Error("map: has no cells");
  if (width > kMaxCells || height > kMaxCells ||
      message.data.size() != std::uint64_t{width} * height) {
    throw Error(
        fmt::format("map: {} cells of data, expected {} x {}", message.data.size(), width, height));
  }
}

}  // namespace

PlanarPose to_planar(const RigidTransform& X) {
  return {X.translation.x(), X.translation.y(), yaw_of(X.rotation)};
}

Time time_of(const ros::Time& stamp) {
  return Time{} + std::chrono::seconds(stamp.sec) + std::chrono::nanoseconds(stamp.nsec);
}

ros::Time ros_time(Time time) {
  ros::Time converted;
  converted.fromNSec(
      static_cast<std::uint64_t>(std::max<std::int64_t>(0, time.time_since_epoch().count())));
  return converted;
}

LaserScan scan_of(const sensor_msgs::LaserScan& message) {
  check_angles(message);
  LaserScan scan;
  scan.stamp = time_of(message.header.stamp);
  scan.beam_interval = duration_from_seconds(static_cast<double>(message.time_increment));
  scan.first_angle_rad = static_cast<double>(message.angle_min);
  scan.angle_step_rad = static_cast<double>(message.angle_increment);
  scan.min_range_m = static_cast<double>(message.range_min);
  scan.max_range_m = std::min(kMaxRange, static_cast<double>(message.range_max));
  scan.ranges_m.reserve(message.ranges.size());
  for (const float range : message.ranges) scan.ranges_m.push_back(range_of(range, scan));
  return scan;
}

OccupancyGrid grid_of(const nav_msgs::OccupancyGrid& message) {
  check_size(message);
  const double resolution = static_cast<double>(message.info.resolution);
  if (!(resolution > 0.0) || !std::isfinite(resolution)) {
    throw Error(fmt::format("map: resolution is {}, expected > 0", resolution));
  }
  RigidTransform X_MO;
  try {
    X_MO = transform_of(message.info.origin);
  } catch (const Error& error) {
    throw Error(fmt::format("map: its origin's {}", error.what()));
  }
  if (std::abs(yaw_of(X_MO.rotation)) > kStraight) {
    throw Error(fmt::format("map: is rotated by {} rad, expected 0", yaw_of(X_MO.rotation)));
  }
  OccupancyGrid grid;
  grid.resolution_m = resolution;
  grid.width = static_cast<int>(message.info.width);
  grid.height = static_cast<int>(message.info.height);
  grid.origin = X_MO.translation.head<2>();
  grid.cells.assign(message.data.begin(), message.data.end());
  for (std::int8_t& cell : grid.cells) {
    if (cell > 100 || cell < 0) cell = -1;
  }
  return grid;
}

nav_msgs::OccupancyGrid grid_message(const OccupancyGrid& grid, const std::string& frame,
                                     const ros::Time& stamp) {
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.info.map_load_time = stamp;
  message.info.resolution = static_cast<float>(grid.resolution_m);
  message.info.width = static_cast<std::uint32_t>(grid.width);
  message.info.height = static_cast<std::uint32_t>(grid.height);
  message.info.origin = planar_message({grid.origin.x(), grid.origin.y(), 0.0});
  message.data.assign(grid.cells.begin(), grid.cells.end());
  return message;
}

RigidTransform transform_of(const geometry_msgs::Pose& message) {
  const auto& q = message.orientation;
  const auto& p = message.position;
  return checked_pose({q.w, q.x, q.y, q.z}, {p.x, p.y, p.z});
}

RigidTransform transform_of(const geometry_msgs::Transform& message) {
  const auto& q = message.rotation;
  const auto& p = message.translation;
  return checked_pose({q.w, q.x, q.y, q.z}, {p.x, p.y, p.z});
}

geometry_msgs::Pose planar_message(const PlanarPose& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  message.orientation.z = std::sin(0.5 * pose.yaw);
  message.orientation.w = std::cos(0.5 * pose.yaw);
  return message;
}

geometry_msgs::Transform transform_message(const RigidTransform& X) {
  geometry_msgs::Transform message;
  message.translation.x = X.translation.x();
  message.translation.y = X.translation.y();
  message.translation.z = X.translation.z();
  message.rotation.x = X.rotation.x();
  message.rotation.y = X.rotation.y();
  message.rotation.z = X.rotation.z();
  message.rotation.w = X.rotation.w();
  return message;
}

Eigen::Matrix3d covariance_of(const geometry_msgs::PoseWithCovariance& message) {
  Eigen::Matrix3d covariance;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      covariance(row, column) = message.covariance[6 * kPlanarRows[row] + kPlanarRows[column]];
    }
  }
  if (!covariance.allFinite()) throw Error("covariance is not finite");
  if ((covariance.diagonal().array() < 0.0).any()) throw Error("covariance has variances below 0");
  covariance.diagonal() = covariance.diagonal().cwiseMax(kMinVariance);
  return covariance;
}

geometry_msgs::PoseWithCovariance covariance_message(const PlanarPose& pose,
                                                     const Eigen::Matrix3d& covariance) {
  geometry_msgs::PoseWithCovariance message;
  message.pose = planar_message(pose);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      message.covariance[6 * kPlanarRows[row] + kPlanarRows[column]] = covariance(row, column);
    }
  }
  return message;
}

nav_msgs::Path path_message(const std::vector<Eigen::Vector2d>& way, const std::string& frame,
                            const ros::Time& stamp) {
  nav_msgs::Path message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  double yaw = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i + 1 < way.size()) {
      const Eigen::Vector2d ahead = way[i + 1] - way[i];
      yaw = std::atan2(ahead.y(), ahead.x());
    }
    geometry_msgs::PoseStamped pose;
    pose.header = message.header;
    pose.pose = planar_message({way[i].x(), way[i].y(), yaw});
    message.poses.push_back(pose);
  }
  return message;
}

std::string frame_of_message(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace tagfield
