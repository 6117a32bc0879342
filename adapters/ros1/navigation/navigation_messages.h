// SPDX-License-Identifier: Apache-2.0
/// @file
/// Scans, maps and poses of the floor to ROS messages and back.
///
/// What comes in is checked: all of these throw Error, in one line, on numbers that nobody can use.
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

/// REP-117: +inf met nothing, -inf was too near, NaN is invalid. Finite ranges of range_max and
/// more met nothing either, as lasers from before REP-117 say that; those below range_min are
/// invalid. Ranges above kMostRange are cut.
LaserScan scan_of(const sensor_msgs::LaserScan& message);
inline constexpr double kMostRange = 1000.0;  ///< [m]

/// Cells beyond -1 … 100 are unknown. Throws Error also on a map whose size is not that of its data
/// and on one that is turned: cells lie along the axes.
OccupancyGrid grid_of(const nav_msgs::OccupancyGrid& message);
nav_msgs::OccupancyGrid grid_message(const OccupancyGrid& grid, const std::string& frame,
                                     const ros::Time& stamp);

RigidTransform transform_of(const geometry_msgs::Pose& message);
RigidTransform transform_of(const geometry_msgs::Transform& message);
geometry_msgs::Pose planar_message(const PlanarPose& pose);
geometry_msgs::Transform transform_message(const RigidTransform& X);

/// Of x, y, yaw out of the six rows of x, y, z, roll, pitch, yaw. No variance is less than 1e-6, so
/// that who is surely somewhere is not nowhere.
Eigen::Matrix3d covariance_of(const geometry_msgs::PoseWithCovariance& message);
geometry_msgs::PoseWithCovariance covariance_message(const PlanarPose& pose,
                                                     const Eigen::Matrix3d& covariance);

/// Each pose looks along the way.
nav_msgs::Path path_message(const std::vector<Eigen::Vector2d>& way, const std::string& frame,
                            const ros::Time& stamp);

/// A frame's name without the slash that ROS once put in front.
std::string frame_of_message(const std::string& frame);

}  // namespace tagfield
