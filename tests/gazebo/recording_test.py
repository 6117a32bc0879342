#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A Gazebo world that records an MCAP file, compared with a rosbag of the same run."""

import os
import re
import signal

from gazebo import (Run, Skip, antenna, case, check, check_equal, check_in, check_near, main, read_csv, run,
                    schedule, tag, world)


def recording(*elements):
    return ('<plugin name="recording" filename="libTagfieldRecordingPlugin.so">'
            f'{"".join(elements)}</plugin>')


def located(context, recorded, out):
    """Folder with the results of `tagfield localize` from a recording."""
    warnings = context.run_well("localize", recorded, "--method", "hyperbola", "--out", out).err
    check("no transform joins" not in warnings, f"frames of {recorded}: {warnings}")
    return context.folder / out


def rows_until(path, last):
    return [row for row in read_csv(path) if float(row["stamp_s"]) <= last]


def errors_in(running):
    text = re.sub(r"\x1b\[[\d;]*m", "", running.log())
    return [line for line in re.split(r"\n|(?=\[Err\])", text) if line.startswith("[Err]") and
            "display" not in line and "audio" not in line]


@case
def it_holds_what_ros1_hears(context):
    log, mcap = context.folder / "log", context.folder / "run.mcap"
    text = world(recording(f"<mcap>{mcap}</mcap>"), schedule(log, stop=8.0), antenna("gate", 0, 0, 1),
                 antenna("dock", 4, 0, 1), tag("tag1", 2, 1, 1), tag("tag2", 2, -1, 1.5))
    with Run(context, text, record=True) as running:
        running.finish(log)
        check(not mcap.exists(), "the file has its name while it is written")
        check_equal(errors_in(running), [], "Gazebo's errors")
    if not check(mcap.exists(), f"no file: {sorted(path.name for path in context.folder.iterdir())}"):
        return
    check_equal(sorted(context.folder.glob("*.partial")), [], "what is left")
    bag, own = located(context, running.bag, "of_bag"), located(context, mcap, "of_mcap")
    last = float(read_csv(bag / "reads.csv")[-1]["stamp_s"])
    check(last > 7.0, f"the bag ends at {last} s")
    for name in ("reads.csv", "truth/distances.csv"):
        check_equal(rows_until(own / name, last), rows_until(bag / name, last), name)
    for name in ("truth/tags.csv", "truth/antenna_poses.csv"):
        check_equal(len(read_csv(own / name)) > 0, True, name)
    first = {row["tag"]: row for row in reversed(read_csv(bag / "truth/tags.csv"))}
    check_equal({row["tag"]: row for row in reversed(read_csv(own / "truth/tags.csv"))}, first, "tags")


DRIVING = """\
name: driving
robots:
  - {name: p3at, start: [1, 0, 0.3], speed_m_s: 0.4, waypoints: [[3, 0.5], [3, 2]]}
antennas:
  - {name: mast, on: p3at, pose: [0, 0, 1.5], range_m: 6, communication_gain: 3}
tags:
  - {id: shelf, position: [3, 3, 1.2]}
"""
OF_ROBOT = {"/odom": "nav_msgs/msg/Odometry", "/ground_truth/odom": "nav_msgs/msg/Odometry",
            "/scan": "sensor_msgs/msg/LaserScan"}


@case
def a_robots_ways_scans_and_frames_are_in_it(context):
    scenario = context.write("driving.yaml", DRIVING)
    context.run_well("gazebo", scenario, "--out", context.folder / "driving.world", "--real-time", 1)
    log, mcap = context.folder / "log", context.folder / "run.mcap"
    text = (context.folder / "driving.world").read_text(encoding="utf-8").replace(
        "</world>", recording(f"<mcap>{mcap}</mcap>") + schedule(log, stop=6.0) + "</world>")
    with Run(context, text, record=True) as running:
        running.finish(log)
        check_equal(errors_in(running), [], "Gazebo's errors")
    sample = context.build / "bin/mcap_sample"
    if not sample.exists():
        raise Skip("mcap_sample is not built (TAGFIELD_MCAP, liblz4-dev, libzstd-dev)")
    lines = [line.split() for line in run([sample, "read", mcap], cwd=context.folder).out.splitlines()
             if line.startswith("/")]
    topics = [tuple(line[:2]) for line in lines if not line[1].isdigit()]
    check_equal(len({name for name, _ in topics}), len(topics), "channels, one a topic")
    counts = {}
    for line in lines:
        if line[1].isdigit():
            counts[line[0]] = counts.get(line[0], 0) + 1
    for topic, kind in OF_ROBOT.items():
        check_in((topic, kind), topics, "topics")
        check(counts.get(topic, 0) > 50, f"{counts.get(topic, 0)} messages of {topic}")
    # By tf: from the map via odom and the robot to its antenna.
    context.run_well("localize", mcap, "--method", "hyperbola", "--poses", "tf", "--out", "by_tf")
    believed = read_csv(context.folder / "by_tf/antenna_poses.csv")
    truth = {row["stamp_s"]: row for row in read_csv(context.folder / "by_tf/truth/antenna_poses.csv")}
    check(len(believed) > 60, f"{len(believed)} poses")
    for row in believed:
        for axis in ("x_m", "y_m", "z_m"):
            check_near(float(row[axis]), float(truth[row["stamp_s"]][axis]), 0.1, f"{axis} at {row['stamp_s']} s")
    check(float(believed[-1]["x_m"]) - float(believed[0]["x_m"]) > 1.0, "the robot stood")


@case
def without_ros_and_killed_it_is_there_too(context):
    folder = context.folder / "recordings"
    folder.mkdir()
    text = world(recording(f"<mcap>{folder}/run.mcap</mcap>"), antenna("gate", 0, 0, 1),
                 *(tag(f"tag{i}", 2, 0.02 * i, 1) for i in range(100)), factor=0.0)
    with Run(context, text, master=False) as running:
        # A chunk has about a megabyte.
        running.wait_for("a chunk", lambda: any(path.stat().st_size > 200_000 for path in folder.iterdir()))
        os.killpg(running.server.process.pid, signal.SIGKILL)
    names = [path.name for path in folder.iterdir()]
    if not check(len(names) == 1 and names[0].endswith(".partial"), f"files: {names}"):
        return
    result = context.run("localize", folder / names[0], "--out", "out")
    check_equal(result.code, 0, f"exit code ({result.err[-300:]})")
    check_in("the file is cut off or broken here: it ends without its last records", result.err, "warnings")
    check(len(read_csv(context.folder / "out/reads.csv")) > 1000, "few reads")


@case
def what_is_wrong_is_one_error_and_the_world_goes_on(context):
    log = context.folder / "log"
    text = world(recording("<mcap>/nowhere/run.mcap</mcap>", "<bag>x</bag>"), schedule(log, stop=2.0),
                 antenna("gate", 0, 0, 1), tag("tag1", 2, 1, 1))
    with Run(context, text, record=True) as running:
        running.finish(log)
        errors = errors_in(running)
    check_equal(len(errors), 2, f"errors: {errors}")
    check_in("/nowhere/run.mcap", "".join(errors), "errors")
    check_in("unknown element <bag>, expected <mcap>", "".join(errors), "errors")
    context.run_well("localize", running.bag, "--method", "hyperbola", "--out", "out")
    check(len(read_csv(context.folder / "out/reads.csv")) > 10, "no reads are written")


if __name__ == "__main__":
    main()
