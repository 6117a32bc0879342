// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of scans, maps and poses in the floor plane to and from ROS messages.
///
/// Incoming messages are checked: all functions throw Error, in one line, on unusable numbers.
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/Transform.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/time.h"
#include "tagfield/laser/laser_scan.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// The pose in the floor plane; its height, roll and pitch are dropped.
PlanarPose to_planar(const RigidTransform& X);

Time time_of(const ros::Time& stamp);
/// Times before 0 become 0.
ros::Time ros_time(Time time);

/// REP-117: +inf is no return, -inf too near, NaN invalid. Finite ranges of range_max and more are
/// also no return, as lasers from before REP-117 report that; those below range_min are invalid.
/// Ranges above kMaxRange are clipped.
LaserScan scan_of(const sensor_msgs::LaserScan& message);
inline constexpr double kMaxRange = 1000.0;  ///< [m]

/// Cells outside -1 … 100 are unknown. Throws Error also if a map's size does not match its data,
/// or if it is rotated: cells must be aligned with the axes.
OccupancyGrid grid_of(const nav_msgs::OccupancyGrid& message);
nav_msgs::OccupancyGrid grid_message(const OccupancyGrid& grid, const std::string& frame,
                                     const ros::Time& stamp);

RigidTransform transform_of(const geometry_msgs::Pose& message);
RigidTransform transform_of(const geometry_msgs::Transform& message);
geometry_msgs::Pose planar_message(const PlanarPose& pose);
geometry_msgs::Transform transform_message(const RigidTransform& X);

/// Covariance of x, y, yaw from the six rows of x, y, z, roll, pitch, yaw. Variances are at least
/// 1e-6, so that the distribution of a perfectly known pose is not degenerate.
Eigen::Matrix3d covariance_of(const geometry_msgs::PoseWithCovariance& message);
geometry_msgs::PoseWithCovariance covariance_message(const PlanarPose& pose,
                                                     const Eigen::Matrix3d& covariance);

/// Each pose points along the path.
nav_msgs::Path path_message(const std::vector<Eigen::Vector2d>& way, const std::string& frame,
                            const ros::Time& stamp);

/// A frame's name without the leading slash of early ROS versions.
std::string frame_of_message(const std::string& frame);

}  // namespace tagfield
