# SPDX-License-Identifier: Apache-2.0
"""slam_toolbox maps the world of a scenario while its robot is driven by velocity commands.

    ros2 launch tagfield_bringup slam.launch.py scenario:=scenarios/paper_warehouse_slam.yaml

The arguments of drive.launch.py are accepted, too.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def share(package, *path):
    return PathJoinSubstitution([FindPackageShare(package), *path])


def include(package, name, **arguments):
    return IncludeLaunchDescription(PythonLaunchDescriptionSource(share(package, "launch", name)),
                                    launch_arguments=arguments.items())


def generate_launch_description():
    # slam_toolbox's own launch file handles the node's lifecycle, which exists from Jazzy on.
    slam = include("slam_toolbox", "online_async_launch.py", use_sim_time="true",
                   slam_params_file=share("tagfield_bringup", "params", "slam_toolbox.yaml"))
    # Arguments without a default have to be passed explicitly.
    drive = include("tagfield_bringup", "drive.launch.py", scenario=LaunchConfiguration("scenario"))
    return LaunchDescription([
        DeclareLaunchArgument("scenario", description="Scenario file (YAML)"), drive, slam])
