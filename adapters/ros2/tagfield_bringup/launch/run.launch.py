# SPDX-License-Identifier: Apache-2.0
"""Publishes a scenario to ROS 2, and starts RViz.

    ros2 launch tagfield_bringup run.launch.py scenario:=scenarios/paper_warehouse.yaml speed:=2
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, EmitEvent, ExecuteProcess, RegisterEventHandler
from launch.conditions import IfCondition, UnlessCondition
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    run = ExecuteProcess(
        cmd=[LaunchConfiguration("tagfield"), "run", LaunchConfiguration("scenario"), "--ros2",
             "--speed", LaunchConfiguration("speed"), "--out", LaunchConfiguration("out")],
        output="screen")
    rviz = Node(
        package="rviz2", executable="rviz2", output="screen",
        arguments=["-d", PathJoinSubstitution(
            [FindPackageShare("tagfield_bringup"), "rviz", "tagfield.rviz"])],
        parameters=[{"use_sim_time": True}], condition=IfCondition(LaunchConfiguration("rviz")))
    return LaunchDescription([
        DeclareLaunchArgument("scenario", description="Scenario file (YAML)"),
        DeclareLaunchArgument("tagfield", default_value="tagfield", description="The program"),
        DeclareLaunchArgument("speed", default_value="1", description="Multiple of real time"),
        DeclareLaunchArgument("out", default_value="runs/ros2", description="Folder for results"),
        DeclareLaunchArgument("rviz", default_value="true", description="Whether RViz is started"),
        rviz, run,
        RegisterEventHandler(OnProcessExit(
            target_action=run, on_exit=[EmitEvent(event=Shutdown(reason="the run is over"))]),
            condition=UnlessCondition(LaunchConfiguration("rviz")))])
