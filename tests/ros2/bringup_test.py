#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tagfield_bringup: parameters agree with the program's robot, and launch files start existing things.

Runs without ROS 2: its launch modules are replaced by mocks that record their arguments.
"""

import pathlib
import re
import runpy
import sys
import types

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "command"))

from common import Skip, case, check, check_equal, check_in, main  # noqa: E402

try:
    import yaml
except ImportError:
    yaml = None

LAUNCH = {"launch": ["LaunchDescription"],
          "launch.actions": ["DeclareLaunchArgument", "EmitEvent", "ExecuteProcess", "GroupAction",
                             "IncludeLaunchDescription", "RegisterEventHandler"],
          "launch.conditions": ["IfCondition", "UnlessCondition"],
          "launch.event_handlers": ["OnProcessExit"], "launch.events": ["Shutdown"],
          "launch.launch_description_sources": ["PythonLaunchDescriptionSource"],
          "launch.substitutions": ["LaunchConfiguration", "PathJoinSubstitution", "PythonExpression"],
          "launch_ros.actions": ["Node"], "launch_ros.substitutions": ["FindPackageShare"]}


class Thing:
    """An object that a launch file creates: its class and arguments."""

    def __init__(self, kind, words, options):
        self.kind, self.words, self.options = kind, words, options


def things_in(value):
    """All recorded objects in a value, also nested ones."""
    if isinstance(value, Thing):
        yield value
        yield from things_in([*value.words, *value.options.values()])
    elif isinstance(value, dict):
        yield from things_in(list(value.values()))
    elif isinstance(value, (list, tuple, type({}.items()))):
        for one in value:
            yield from things_in(one)


def launched(path):
    """The content of a launch file's description, with mock launch modules."""
    def maker(kind):
        return lambda *words, **options: Thing(kind, words, options)

    for name, kinds in {"launch_ros": [], **LAUNCH}.items():
        module = types.ModuleType(name)
        for kind in kinds:
            setattr(module, kind, maker(kind))
        sys.modules[name] = module
    try:
        return list(things_in(runpy.run_path(str(path))["generate_launch_description"]()))
    finally:
        for name in ("launch_ros", *LAUNCH):
            del sys.modules[name]


def bringup(context):
    return context.source.resolve() / "adapters/ros2/tagfield_bringup"


def launch_files(context):
    files = sorted((bringup(context) / "launch").glob("*.py"))
    check_equal([path.name for path in files],
                ["drive.launch.py", "navigation.launch.py", "run.launch.py", "slam.launch.py"], "files")
    return files


def parameters(context, name):
    """The parameters in a file, by node."""
    if yaml is None:
        raise Skip("python3-yaml is not there")
    nodes = yaml.safe_load((bringup(context) / "params" / name).read_text(encoding="utf-8"))
    found = {}
    for node, inside in nodes.items():
        found[node] = inside.get(node, inside)["ros__parameters"]
    return found


def number_in(context, header, name):
    """The default value of a member in a header."""
    text = (context.source / "tagfield" / header).read_text(encoding="utf-8")
    return float(re.search(rf"double {name} = ([-\d.]+);", text)[1])


def frame_in(context, name):
    text = (context.source / "adapters/ros2/ros2_robot.h").read_text(encoding="utf-8")
    return re.search(rf'{name} = "(\w+)"', text)[1]


def scenario(context, name="paper_warehouse_slam"):
    if yaml is None:
        raise Skip("python3-yaml is not there")
    text = context.shipped(name).read_text(encoding="utf-8")
    return yaml.safe_load(text)


@case
def launch_files_start_what_the_package_asks_for(context):
    package = (bringup(context) / "package.xml").read_text(encoding="utf-8")
    wanted = set(re.findall(r"<exec_depend>(\w+)</exec_depend>", package))
    used = {"launch", "launch_ros", "tagfield_msgs", "nav2_regulated_pure_pursuit_controller"}
    for path in launch_files(context):
        for thing in launched(path):
            if thing.kind == "Node":
                used.add(thing.options["package"])
            if thing.kind == "FindPackageShare" and thing.words[0] != "tagfield_bringup":
                used.add(thing.words[0])
    check_equal(used, wanted, "packages that are used, and those that are asked for")


@case
def launch_files_name_files_that_are_installed(context):
    cmake = (bringup(context) / "CMakeLists.txt").read_text(encoding="utf-8")
    folders = re.search(r"install\(DIRECTORY ([\w ]+) DESTINATION", cmake)[1].split()
    count = 0
    for path in launch_files(context):
        for thing in launched(path):
            if thing.kind != "PathJoinSubstitution" or thing.words[0][0].words[0] != "tagfield_bringup":
                continue
            folder, name = thing.words[0][1:]
            check_in(folder, folders, "installed folders")
            check((bringup(context) / folder / name).exists(), f"{path.name}: no {folder}/{name}")
            count += 1
    check(count >= 6, f"only {count} files are named")


@case
def launch_files_hand_on_what_has_no_default(context):
    """ROS 2 rejects an included launch file if its arguments without default are not passed explicitly."""
    files = {path.name: launched(path) for path in launch_files(context)}
    needed = {name: {thing.words[0] for thing in things if thing.kind == "DeclareLaunchArgument"
                     and "default_value" not in thing.options} for name, things in files.items()}
    count = 0
    for name, things in files.items():
        for thing in things:
            if thing.kind != "IncludeLaunchDescription":
                continue
            included = next(part.words[0][-1] for part in things_in(thing)
                            if part.kind == "PathJoinSubstitution")
            given = set(dict(thing.options.get("launch_arguments", {})))
            missing = needed.get(included, set()) - given
            check(not missing, f"{name} includes {included} without {', '.join(sorted(missing))}")
            count += included in needed
    check_equal(count, 3, "files that are included")


@case
def launch_files_give_options_that_the_program_has(context):
    help_text = context.run("run", "--help").out
    for path in launch_files(context):
        things = launched(path)
        declared = {thing.words[0] for thing in things if thing.kind == "DeclareLaunchArgument"}
        for thing in things:
            if thing.kind == "ExecuteProcess":
                for word in thing.options["cmd"]:
                    if isinstance(word, str) and word.startswith("--"):
                        check_in(word + " ", help_text, f"{path.name}: options")
            if thing.kind == "LaunchConfiguration":
                check_in(thing.words[0], sorted(declared), f"{path.name}: arguments")


@case
def nodes_that_are_started_have_their_parameters(context):
    nav2 = parameters(context, "nav2.yaml")
    started = {thing.options["name"]: thing for path in launch_files(context)
               for thing in launched(path) if thing.kind == "Node" and "name" in thing.options}
    managers = {name for name in started if name.startswith("lifecycle_manager")}
    check_equal(set(started) - managers, set(nav2) - {"local_costmap", "global_costmap"}, "nodes")
    managed = [name for manager in managers
               for name in started[manager].options["parameters"][0]["node_names"]]
    check_equal(sorted(managed), sorted(set(started) - managers), "nodes that are brought up")
    for name, values in {**nav2, **parameters(context, "slam_toolbox.yaml")}.items():
        check_equal(values.get("use_sim_time"), True, f"{name}: use_sim_time")


@case
def frames_and_topics_are_the_programs(context):
    base, odom = frame_in(context, "kBaseFrame"), frame_in(context, "kOdomFrame")
    check_equal((base, odom), ("base_link", "odom"), "frames")
    frames = {"base_frame": base, "base_frame_id": base, "robot_base_frame": base, "odom_frame": odom,
              "odom_frame_id": odom, "local_frame": odom, "map_frame": "map", "global_frame_id": "map",
              "frame_id": "map"}
    topics = {"scan_topic": "/scan", "topic": "/scan", "odom_topic": "/odom", "map_topic": "/map"}
    docs = (context.source / "docs/ros2.md").read_text(encoding="utf-8")
    robot = (context.source / "adapters/ros2/ros2_robot.cc").read_text(encoding="utf-8")
    for topic in ("/scan", "/odom", "/cmd_vel"):
        check_in(f'"{topic}"', robot, "topics of the robot")
        check_in(f"| `{topic}` |", docs, "topics in the docs")
    count = 0

    def look(values, path):
        nonlocal count
        for key, value in values.items():
            if isinstance(value, dict):
                look(value, f"{path}.{key}")
            elif key in frames or key in topics:
                check_equal(value, {**frames, **topics}[key], f"{path}.{key}")
                count += 1

    nav2 = parameters(context, "nav2.yaml")
    look({**nav2, **parameters(context, "slam_toolbox.yaml")}, "")
    check(count >= 18, f"only {count} frames and topics")
    check_equal([nav2[name]["global_frame"] for name in
                 ("local_costmap", "behavior_server", "global_costmap", "bt_navigator")],
                [odom, odom, "map", "map"], "global_frame")


@case
def limits_are_the_robots(context):
    nav2, slam = parameters(context, "nav2.yaml"), parameters(context, "slam_toolbox.yaml")["slam_toolbox"]
    robot = scenario(context)["robots"][0]
    check("driving" not in scenario(context)["navigation"], "the scenario has limits of its own")
    driver = {name: number_in(context, "navigation/goal_driver.h", name)
              for name in ("radius_m", "margin_m", "clearance_m")}
    limits = {name: number_in(context, "motion/speed_limits.h", name)
              for name in ("speed_m_s", "turn_rad_s", "turn_acceleration_rad_s2")}
    laser = {name: number_in(context, "laser/simulated_laser.h", name)
             for name in ("min_range_m", "max_range_m")}
    follow, behave = nav2["controller_server"]["FollowPath"], nav2["behavior_server"]
    check_equal(follow["desired_linear_vel"], robot["speed_m_s"], "speed")
    follower = scenario(context, "paper_warehouse")["robots"][0]  # Autonomous robots plan their own paths.
    check_equal(follow["lookahead_dist"], follower["look_ahead_m"], "look-ahead")
    check(follow["desired_linear_vel"] <= limits["speed_m_s"], "a speed that the robot can't have")
    for turn in (follow["rotate_to_heading_angular_vel"], behave["max_rotational_vel"]):
        check(turn <= limits["turn_rad_s"], "a turn that the robot can't make")
    for turn in (follow["max_angular_accel"], behave["rotational_acc_lim"]):
        check_equal(turn, limits["turn_acceleration_rad_s2"], "acceleration of turns")
    for name in ("local_costmap", "global_costmap"):
        check_equal(nav2[name]["robot_radius"], driver["radius_m"], f"{name}: radius")
        inflation = nav2[name]["inflation_layer"]["inflation_radius"]
        check(abs(inflation - sum(driver.values())) < 1e-9, f"{name}: inflation {inflation}")
        scan = nav2[name]["obstacle_layer"]["scan"]
        check(scan["obstacle_max_range"] <= scan["raytrace_max_range"] <= laser["max_range_m"], name)
    check_equal((nav2["amcl"]["laser_min_range"], nav2["amcl"]["laser_max_range"]),
                (laser["min_range_m"], laser["max_range_m"]), "amcl's laser")
    check_equal(slam["max_laser_range"], laser["max_range_m"], "slam_toolbox's laser")
    start = nav2["amcl"]["initial_pose"]
    check_equal([start["x"], start["y"], start["yaw"]], robot["start"], "where the robot starts")


@case
def rviz_shows_topics_that_there_are(context):
    if yaml is None:
        raise Skip("python3-yaml is not there")
    of_others = {"/global_costmap/costmap", "/plan", "/initialpose", "/goal_pose"}
    docs = (context.source / "docs/ros2.md").read_text(encoding="utf-8")
    for name in ("tagfield.rviz", "navigation.rviz"):
        text = (bringup(context) / "rviz" / name).read_text(encoding="utf-8")
        config = yaml.safe_load(text)["Visualization Manager"]
        check_equal(config["Global Options"]["Fixed Frame"], "map", f"{name}: fixed frame")
        for thing in (*config["Displays"], *config["Tools"]):
            topic = thing.get("Topic", {}).get("Value")
            check(topic is None or topic in of_others or f"`{topic}`" in docs, f"{name}: {topic}")


if __name__ == "__main__":
    main()
