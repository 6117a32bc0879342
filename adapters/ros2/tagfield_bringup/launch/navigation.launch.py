# SPDX-License-Identifier: Apache-2.0
"""Nav2 drives the robot of a scenario to goals (RViz: 2D Goal Pose).

    ros2 launch tagfield_bringup navigation.launch.py scenario:=scenarios/paper_warehouse_slam.yaml
    ros2 launch tagfield_bringup navigation.launch.py scenario:=… map:=runs/paper_warehouse_slam/map.yaml

Without a map, slam_toolbox builds one while driving; with a map, amcl localizes the robot on it. The
arguments of drive.launch.py are accepted, too.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, PythonExpression
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def share(*path):
    return PathJoinSubstitution([FindPackageShare("tagfield_bringup"), *path])


def include(name):
    # Arguments without a default have to be passed explicitly.
    arguments = {"scenario": LaunchConfiguration("scenario")}
    return IncludeLaunchDescription(PythonLaunchDescriptionSource(share("launch", name)),
                                    launch_arguments=arguments.items())


def managed(manager, nodes, *parameters):
    """Nodes of (package, executable), named like the executable, and their lifecycle manager."""
    started = [Node(package=package, executable=name, name=name, output="screen",
                    parameters=[share("params", "nav2.yaml"), *parameters])
               for package, name in nodes]
    names = [name for _, name in nodes]
    return [*started, Node(
        package="nav2_lifecycle_manager", executable="lifecycle_manager", name=manager, output="screen",
        parameters=[{"use_sim_time": True, "autostart": True, "node_names": names}])]


def generate_launch_description():
    chosen = LaunchConfiguration("map")
    on_map = GroupAction(
        [include("drive.launch.py"),
         *managed("lifecycle_manager_localization",
                  [("nav2_map_server", "map_server"), ("nav2_amcl", "amcl")],
                  {"yaml_filename": chosen})],
        condition=IfCondition(PythonExpression(["'", chosen, "' != ''"])))
    mapping = GroupAction(
        [include("slam.launch.py")],
        condition=IfCondition(PythonExpression(["'", chosen, "' == ''"])))
    # Not by nav2_bringup's launch file: its nodes and arguments differ between distributions.
    navigation = managed("lifecycle_manager_navigation",
                         [("nav2_controller", "controller_server"), ("nav2_planner", "planner_server"),
                          ("nav2_behaviors", "behavior_server"),
                          ("nav2_bt_navigator", "bt_navigator")])
    return LaunchDescription([
        DeclareLaunchArgument("scenario", description="Scenario file (YAML)"),
        DeclareLaunchArgument("map", default_value="", description="Map's YAML file, or none"),
        on_map, mapping, *navigation])
