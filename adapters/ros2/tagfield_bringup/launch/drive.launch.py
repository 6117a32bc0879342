# SPDX-License-Identifier: Apache-2.0
"""Publishes a scenario, whose robot is driven by velocity commands, to ROS 2, and starts RViz.

    ros2 launch tagfield_bringup drive.launch.py scenario:=scenarios/paper_warehouse_slam.yaml
    ros2 run teleop_twist_keyboard teleop_twist_keyboard
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    run = ExecuteProcess(
        cmd=[LaunchConfiguration("tagfield"), "run", LaunchConfiguration("scenario"), "--ros2",
             "--drive", LaunchConfiguration("robot"), "--out", LaunchConfiguration("out")],
        output="screen")
    rviz = Node(
        package="rviz2", executable="rviz2", output="screen",
        arguments=["-d", PathJoinSubstitution(
            [FindPackageShare("tagfield_bringup"), "rviz", "navigation.rviz"])],
        parameters=[{"use_sim_time": True}], condition=IfCondition(LaunchConfiguration("rviz")))
    return LaunchDescription([
        DeclareLaunchArgument("scenario", description="Scenario file (YAML)"),
        DeclareLaunchArgument("robot", default_value="p3at", description="Robot that is driven"),
        DeclareLaunchArgument("tagfield", default_value="tagfield", description="The program"),
        DeclareLaunchArgument("out", default_value="runs/ros2", description="Folder for results"),
        DeclareLaunchArgument("rviz", default_value="true", description="Whether RViz is started"),
        run, rviz])
