// SPDX-License-Identifier: Apache-2.0
/// @file
/// SDF parameters of libTagfieldRobotPlugin.so and libTagfieldLiftPlugin.so.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"
#include "tagfield/base/time.h"
#include "tagfield/motion/lift.h"
#include "tagfield/motion/path_follower.h"
#include "tagfield/motion/robot_driver.h"
#include "tagfield/motion/wheel_odometry.h"

namespace tagfield {

/// Parameters of the robot plugin; `[unit] default`.
///
/// Wheels: `left_joint`, `right_joint` (each may be repeated) front_left_wheel_joint and
/// rear_left_wheel_joint, front_right_… and rear_right_…; `wheel_radius` [m] 0.111; `track` [m]
/// 0.4, used to convert velocities to wheel speeds; `torque` [N·m] 10, the maximum of a wheel's
/// motor.
///
/// Driving: `max_speed` [m/s] 0.8; `max_turn` [rad/s] 1.5; `max_acceleration` [m/s²] 1;
/// `max_turn_acceleration` [rad/s²] 3; `cmd_timeout` [s of simulated time] 0.5, how long a command
/// is valid.
///
/// Path: `path` with `waypoint`s "x y" [m, world], none; `speed` [m/s] 0.3; `look_ahead` [m] 0.5;
/// `steering_rate` [Hz of simulated time] 20, the rate of steering decisions.
///
/// Odometry: `odometry_rate` [Hz of simulated time] 50; `odometry_track` [m], the effective track,
/// as `track`; `encoder_ticks` (per wheel revolution) 0 for an ideal encoder;
/// `odometry_wheel_noise` [m/√m] 0.002, the error of a side's travel for the published covariance
/// (no noise is added).
///
/// Laser: `laser`, the name of a `ray` sensor on the base link; none.
///
/// Frames: `base_link` base_link, the link of the model and its frame; `odom_frame` odom;
/// `laser_frame` laser; `odom_parent_frame` none: if given, the transform from it to odom is
/// published, which is the robot's initial pose in the world; `publish_tf` true; `robotNamespace`
/// of the topics, none.
struct RobotParameters {
  std::vector<std::string> left_joints;
  std::vector<std::string> right_joints;
  DriveGeometry drive;
  double torque_nm = 10.0;
  DriverSettings driver;
  std::vector<Eigen::Vector2d> waypoints;  ///< [m, world]
  DrivingStyle style;
  double odometry_rate_hz = 50.0;
  OdometrySettings odometry;
  std::string laser;
  std::string base_link = "base_link";
  std::string odom_frame = "odom";
  std::string laser_frame = "laser";
  std::string odom_parent_frame;
  bool publish_tf = true;
  std::string name_space;
};

/// Reads the parameters; elements inside others (`path`) are separate parameters. If one is given
/// more than once, the last counts, except for joints and waypoints. Throws Error on an invalid
/// value, naming the parameter. Warns of unknown parameters.
RobotParameters robot_from(const std::vector<RawParameter>& parameters, Diagnostics& diagnostics);

/// Parameters of the lift plugin; `[unit] default`.
///
/// `joint`, the prismatic joint, required; `speed` [m/s] 0.35; `lower` and `upper` [m, position of
/// the joint] 0 and 1; `force` [N] 1000, the maximum of the motor; `joint_states_rate` [Hz of
/// simulated time] 50; `topic` lift/command; `robotNamespace` of the topics, none.
struct LiftParameters {
  std::string joint;
  Lift lift{1.0, 0.35};
  double lower_m = 0.0;
  double force_n = 1000.0;
  double joint_states_rate_hz = 50.0;
  std::string topic = "lift/command";
  std::string name_space;
};

/// As robot_from().
LiftParameters lift_from(const std::vector<RawParameter>& parameters, Diagnostics& diagnostics);

}  // namespace tagfield
