#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The warehouse experiment in the real Gazebo, from driving to the tags' estimated positions, and the
same reads headless."""

import subprocess

from gazebo import (
    TOP, case, check, check_between, check_equal, main, read_csv, read_json, require_gazebo)

SCENARIO = TOP / "scenarios/paper_warehouse.yaml"
# What the paper's scenario lacks: a lift, a fixed antenna, tags on the robot.
MOVING = """\
name: moving
robots:
  - {name: p3at, start: [0, 0, 0.3], speed_m_s: 0.4, waypoints: [[2, 0.5], [2, 2]]}
antennas:
  - {name: mast, on: p3at, pose: [0, 0, 1.5], range_m: 6, communication_gain: 3,
     lift: {travel_m: 1.0, speed_m_s: 0.35}}
  - {name: door, pose: [3, -1, 2], range_m: 6}
tags:
  - {id: shelf, position: [3, 3, 1.2]}
  - {id: "E280 1170", position: [-1, 2, 0.4]}
"""


def experiment(context, scenario, out, *options):
    """Runs a scenario in Gazebo; returns the folder with the bag and its results."""
    require_gazebo(context)
    done = subprocess.run(
        [str(TOP / "scripts/gazebo-experiment"), str(scenario), "--out", str(out),
         "--time-limit", "240", "--tagfield", str(context.tagfield), "--plugins", str(context.plugins), *options],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    check_equal(done.returncode, 0, f"exit code; it said {done.stdout[-1500:]}")
    return out


def check_replays(context, scenario, run, *settings):
    """Checks that replaying Gazebo's poses headless gives the same reads byte for byte."""
    replayed = context.folder / f"replay_of_{run.name}"
    antennas = {row["antenna"] for row in read_csv(run / "truth/antenna_poses.csv")}
    recorded = [f"antennas.{name}.recorded={run}/truth/antenna_poses.csv"
                for name in sorted(antennas)]
    words = [word for setting in (*recorded, f"tag_recording={run}/truth/tags.csv", *settings)
             for word in ("--set", setting)]
    context.run_well("run", scenario, "--out", replayed, "--no-page", *words)
    # The order of antennas that update at the same stamp is undefined.
    expected = sorted((run / "reads.csv").read_bytes().splitlines())
    actual = sorted((replayed / "reads.csv").read_bytes().splitlines())
    check(len(expected) > 100, "there are no reads to compare")
    check_equal(len(actual), len(expected), "reads in the replay")
    check(actual == expected, "the replay's reads are not the recording's")


@case
def ten_tags_are_located_and_the_headless_simulator_reads_the_same(context):
    run = experiment(context, SCENARIO, context.folder / "gazebo")
    summary = read_json(run / "summary.json")
    check_equal(summary["pose"], "true", "pose")
    check_between(summary["path_length_m"], 20.0, 25.0, "path [m]")
    check_equal(summary["located"], 10, "tags located")
    check_equal(summary["over_0_3_m"], 0, "tags over 0.3 m")
    check(summary["error_m"]["mean"] <= 0.020, f"mean error is {summary['error_m']['mean']} m")
    beside = summary["compared_pose"]
    check_equal(beside["pose"], "odometry", "pose compared with")
    check(beside["located"] > 0 and beside["error_m"]["mean"] > summary["error_m"]["mean"],
          f"with odometry: {beside}")
    check((run / "report.html").stat().st_size > 10_000, "report.html is small")
    check_replays(context, SCENARIO, run)


@case
def a_lift_and_an_antenna_at_rest_replay_too(context):
    scenario = context.write("moving.yaml", MOVING)
    run = experiment(context, scenario, context.folder / "moving")
    heights = [float(row["z_m"]) for row in read_csv(run / "truth/antenna_poses.csv")
               if row["antenna"] == "mast"]
    check(max(heights) - min(heights) > 0.9, f"the lift goes from {min(heights)} to {max(heights)}")
    check_replays(context, scenario, run)


if __name__ == "__main__":
    main()
