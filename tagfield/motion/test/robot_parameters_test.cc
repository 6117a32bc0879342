// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/robot_parameters.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

RawParameter parameter(const std::string& key, const std::string& value) {
  return {key, value, {}};
}

RobotParameters read(const std::vector<RawParameter>& parameters) {
  Diagnostics diagnostics;
  RobotParameters robot = robot_from(parameters, diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  return robot;
}

std::string error_of(const std::vector<RawParameter>& parameters) {
  Diagnostics diagnostics;
  try {
    robot_from(parameters, diagnostics);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string lift_error_of(const std::vector<RawParameter>& parameters) {
  Diagnostics diagnostics;
  try {
    lift_from(parameters, diagnostics);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RobotFrom, HasTheStatedDefaults) {
  const RobotParameters robot = read({});
  EXPECT_EQ(robot.left_joints.size(), 2U);
  EXPECT_EQ(robot.drive.wheel_radius_m, 0.111);
  EXPECT_EQ(robot.drive.track_m, 0.4);
  EXPECT_EQ(robot.odometry.drive.track_m, 0.4);
  EXPECT_EQ(robot.odometry.encoder_step_rad, 0.0);
  EXPECT_EQ(robot.driver.limits.speed_m_s, 0.8);
  EXPECT_EQ(robot.driver.command_timeout, std::chrono::milliseconds(500));
  EXPECT_EQ(robot.driver.steering_interval, std::chrono::milliseconds(50));
  EXPECT_EQ(robot.odometry_rate_hz, 50.0);
  EXPECT_EQ(robot.base_link, "base_link");
  EXPECT_TRUE(robot.odom_parent_frame.empty());
  EXPECT_TRUE(robot.laser.empty());
  EXPECT_TRUE(robot.waypoints.empty());
}

TEST(RobotFrom, ReadsEachParameter) {
  const RobotParameters robot = read({parameter("left_joint", "a"),
                                      parameter("right_joint", "b"),
                                      parameter("wheel_radius", "0.2"),
                                      parameter("track", "0.6"),
                                      parameter("odometry_track", "0.7"),
                                      parameter("torque", "3"),
                                      parameter("max_speed", "1.1"),
                                      parameter("max_turn", "0.9"),
                                      parameter("max_acceleration", "0.5"),
                                      parameter("max_turn_acceleration", "0.4"),
                                      parameter("cmd_timeout", "0.25"),
                                      parameter("steering_rate", "10"),
                                      parameter("path", ""),
                                      parameter("waypoint", "1 -2"),
                                      parameter("waypoint", " 3.5\t4 "),
                                      parameter("speed", "0.2"),
                                      parameter("look_ahead", "0.3"),
                                      parameter("odometry_rate", "100"),
                                      parameter("encoder_ticks", "360"),
                                      parameter("odometry_wheel_noise", "0"),
                                      parameter("laser", "eye"),
                                      parameter("base_link", "body"),
                                      parameter("odom_frame", "o"),
                                      parameter("laser_frame", "l"),
                                      parameter("odom_parent_frame", "world"),
                                      parameter("publish_tf", "false"),
                                      parameter("robotNamespace", "one")});
  EXPECT_EQ(robot.left_joints, std::vector<std::string>{"a"});
  EXPECT_EQ(robot.right_joints, std::vector<std::string>{"b"});
  EXPECT_EQ(robot.drive.wheel_radius_m, 0.2);
  EXPECT_EQ(robot.drive.track_m, 0.6);
  EXPECT_EQ(robot.odometry.drive.wheel_radius_m, 0.2);
  EXPECT_EQ(robot.odometry.drive.track_m, 0.7);
  EXPECT_EQ(robot.torque_nm, 3.0);
  EXPECT_EQ(robot.driver.limits.speed_m_s, 1.1);
  EXPECT_EQ(robot.driver.limits.turn_rad_s, 0.9);
  EXPECT_EQ(robot.driver.limits.acceleration_m_s2, 0.5);
  EXPECT_EQ(robot.driver.limits.turn_acceleration_rad_s2, 0.4);
  EXPECT_EQ(robot.driver.command_timeout, std::chrono::milliseconds(250));
  EXPECT_EQ(robot.driver.steering_interval, std::chrono::milliseconds(100));
  ASSERT_EQ(robot.waypoints.size(), 2U);
  EXPECT_EQ(robot.waypoints[0], Eigen::Vector2d(1.0, -2.0));
  EXPECT_EQ(robot.waypoints[1], Eigen::Vector2d(3.5, 4.0));
  EXPECT_EQ(robot.style.speed_m_s, 0.2);
  EXPECT_EQ(robot.style.look_ahead_m, 0.3);
  EXPECT_EQ(robot.style.max_turn_rad_s, 0.9);
  EXPECT_EQ(robot.odometry_rate_hz, 100.0);
  EXPECT_NEAR(robot.odometry.encoder_step_rad, kTwoPi / 360.0, 1e-15);
  EXPECT_EQ(robot.odometry.wheel_noise, 0.0);
  EXPECT_EQ(robot.laser, "eye");
  EXPECT_EQ(robot.base_link, "body");
  EXPECT_EQ(robot.odom_frame, "o");
  EXPECT_EQ(robot.laser_frame, "l");
  EXPECT_EQ(robot.odom_parent_frame, "world");
  EXPECT_FALSE(robot.publish_tf);
  EXPECT_EQ(robot.name_space, "one");
}

TEST(RobotFrom, NamesTheParameterThatIsWrong) {
  EXPECT_EQ(error_of({parameter("wheel_radius", "-0.1")}),
            "<wheel_radius> is '-0.1', expected a number > 0");
  EXPECT_EQ(error_of({parameter("track", "nan")}), "<track> is 'nan', expected a number");
  EXPECT_EQ(error_of({parameter("odometry_rate", "0")}),
            "<odometry_rate> is '0', expected a rate [Hz], 1e-6 to 1e6");
  EXPECT_EQ(error_of({parameter("encoder_ticks", "-5")}),
            "<encoder_ticks> is '-5', expected a number, 0 or more");
  EXPECT_EQ(error_of({parameter("waypoint", "1 2 3")}),
            "<waypoint> is '1 2 3', expected two numbers 'x y' [m]");
  EXPECT_EQ(error_of({parameter("publish_tf", "maybe")}),
            "<publish_tf> is 'maybe', expected true or false");
}

TEST(RobotFrom, RefusesRatesAndTimesThatNoClockCanKeep) {
  EXPECT_NE(error_of({parameter("cmd_timeout", "1e300")}), "");
  EXPECT_NE(error_of({parameter("odometry_rate", "1e300")}), "");
  EXPECT_NE(error_of({parameter("steering_rate", "1e300")}), "");
}

TEST(RobotFrom, WarnsOfAMisspeltParameter) {
  Diagnostics diagnostics;
  robot_from({parameter("wheel_radus", "0.1")}, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_EQ(diagnostics.warnings()[0],
            "unknown parameter <wheel_radus> (did you mean 'wheel_radius'?)");
}

TEST(LiftFrom, ReadsEachParameter) {
  Diagnostics diagnostics;
  const LiftParameters lift = lift_from(
      {parameter("joint", "mast"), parameter("speed", "0.1"), parameter("lower", "-0.5"),
       parameter("upper", "0.25"), parameter("force", "30"), parameter("joint_states_rate", "10"),
       parameter("topic", "up"), parameter("robotNamespace", "one")},
      diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  EXPECT_EQ(lift.joint, "mast");
  EXPECT_EQ(lift.lift.speed_m_s, 0.1);
  EXPECT_EQ(lift.lift.travel_m, 0.75);
  EXPECT_EQ(lift.lower_m, -0.5);
  EXPECT_EQ(lift.force_n, 30.0);
  EXPECT_EQ(lift.joint_states_rate_hz, 10.0);
  EXPECT_EQ(lift.topic, "up");
  EXPECT_EQ(lift.name_space, "one");
}

TEST(LiftFrom, NamesTheParameterThatIsWrong) {
  EXPECT_EQ(lift_error_of({}), "<joint> is missing, expected the name of a prismatic joint");
  EXPECT_EQ(lift_error_of({parameter("joint", "m"), parameter("speed", "0")}),
            "<speed> is '0', expected a number > 0");
  EXPECT_EQ(lift_error_of({parameter("joint", "m"), parameter("upper", "-1")}),
            "<upper> is '-1', expected a number over <lower>, 0");
}

}  // namespace
}  // namespace tagfield
