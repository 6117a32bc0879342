#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A robot in the real Gazebo with ROS nodes: it maps a part of the hall, localizes itself on the map,
drives to goals and reads tags, which are located from the bag with poses by tf."""

import subprocess

from gazebo import TOP, Skip, case, check, check_equal, main, read_json, require_gazebo

SCENARIO = """\
name: short_slam
world: {path: %s/worlds/small_warehouse.sdf}
robots:
  - {name: p3at, start: [-1.4, -1.5, -1.5708], speed_m_s: 0.4, waypoints: [[-1.4, -5.2], [-2.4, -1]]}
antennas:
  - {name: mobile, on: p3at, pose: [0, 0, 1.5], range_m: 7, communication_gain: 3}
tags:
  - {id: tag6, position: [-4.58, -6.6, 1.75]}
  - {id: tag7, position: [-4.58, -3.8, 1.25]}
navigation: {mode: slam}
localization: {method: hyperbola, tag_heights: known}
"""
MAPPING_S = 25.0


@case
def the_robot_reaches_its_goals_on_its_own_map_and_tags_are_located_by_tf(context):
    require_gazebo(context)
    if not (context.tagfield.parent / "tagfield_mapping_node").exists():
        raise Skip("the nodes are not built (roscpp is missing)")
    scenario = context.write("short_slam.yaml", SCENARIO % context.source)
    out = context.folder / "slam"
    done = subprocess.run(
        [str(TOP / "scripts/gazebo-experiment"), "--slam", str(scenario), "--out", str(out),
         "--explore-for", str(MAPPING_S), "--time-limit", "600",
         "--tagfield", str(context.tagfield), "--plugins", str(context.plugins)],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    check_equal(done.returncode, 0, f"exit code; it said {done.stdout[-1500:]}")
    goals = read_json(out / "goals.json")
    check_equal([goal["outcome"] for goal in goals], ["reached", "reached"], "goals")
    for goal in goals:
        check(goal["off_goal_m"] < 0.1 and goal["off_goal_rad"] < 0.1, f"off the goal: {goal}")
        check(goal["pose_error_m"] < 0.05 and goal["pose_error_rad"] < 0.02, f"pose: {goal}")
    summary = read_json(out / "summary.json")
    check_equal(summary["pose"], "tf", "pose")
    check_equal(summary["located"], 2, "tags located")
    check(summary["error_m"]["max"] < 0.3, f"tags: {summary['error_m']}")
    beside = summary["compared_pose"]
    check_equal(beside["pose"], "true", "pose compared with")
    # Not "less than by tf": with only two tags, pose errors may cancel, and once did.
    check_equal(beside["located"], 2, "tags located with the true pose")
    check(beside["error_m"]["max"] < 0.05, f"with the true pose: {beside}")
    check(0 < beside["position_rms_m"] < 0.05, f"how far the poses are apart: {beside}")


if __name__ == "__main__":
    main()
