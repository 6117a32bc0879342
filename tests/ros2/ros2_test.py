#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A run published to ROS 2, received by another DDS (Fast DDS, ros2_listener) in a network namespace.

Messages are decoded by this test, independently, by the rules of CDR.
"""

import json
import os
import pathlib
import struct
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "command"))

from common import (Skip, case, check, check_equal, check_in, clean_environment,  # noqa: E402
                    main, read_csv, read_json)

READS = "rt/rfid/reads=tagfield_msgs::msg::dds_::TagReads_"
TAGS = "rt/rfid/truth/tags=tagfield_msgs::msg::dds_::TagPositions_:transient_local"
CLOCK = "rt/clock=rosgraph_msgs::msg::dds_::Clock_:best_effort"
MAP = "rt/map=nav_msgs::msg::dds_::OccupancyGrid_:transient_local"
ROBOT_SCAN = "rt/p3at/scan=sensor_msgs::msg::dds_::LaserScan_:best_effort"
STATIC_TF = "rt/tf_static=tf2_msgs::msg::dds_::TFMessage_:transient_local"
GRAPH = "ros_discovery_info=rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_:transient_local"
DOMAIN = 7


class Cdr:
    """Decodes values from the bytes of a message."""

    def __init__(self, text):
        data = bytes.fromhex(text)
        check_equal(data[:4], b"\0\1\0\0", "header of CDR")
        self.data = data[4:]
        self.at = 0

    def number(self, form):
        size = struct.calcsize(form)
        self.at += -self.at % size
        self.at += size
        return struct.unpack("<" + form, self.data[self.at - size:self.at])[0]

    def text(self):
        size = self.number("I")
        self.at += size
        return self.data[self.at - size:self.at - 1].decode("utf-8")

    def stamp(self):
        seconds = self.number("i")
        return seconds + self.number("I") * 1e-9

    def header(self):
        return self.stamp(), self.text()


def tag_reads(cdr):
    """(stamp, antenna, epc, phase, rssi, frequency) of each read of a TagReads."""
    cdr.header()
    cdr.text()
    found = []
    for _ in range(cdr.number("I")):
        stamp, _ = cdr.header()
        epc, _, antenna = cdr.text(), cdr.text(), cdr.text()
        frequency, phase, rssi = cdr.number("d"), cdr.number("d"), cdr.number("d")
        cdr.number("d")
        found.append((stamp, antenna, epc, phase, rssi, frequency))
    return found


def in_own_network(context, script):
    """Runs a shell script in a separate network namespace with only a loopback interface."""
    set_up = ("ip link set lo up && ip link set lo multicast on && "
              "ip route add 224.0.0.0/4 dev lo && ")
    unshare = ["unshare", "--net"] if os.geteuid() == 0 else ["unshare", "--net", "--map-root-user"]
    tried = subprocess.run([*unshare, "sh", "-c", set_up + "true"], capture_output=True, text=True,
                           check=False)
    if tried.returncode != 0:
        raise Skip(f"no network of one's own can be had: {tried.stderr.strip()[:200]}")
    return subprocess.run([*unshare, "sh", "-c", set_up + script], cwd=context.folder,
                          env=clean_environment(), capture_output=True, text=True, timeout=120,
                          check=False)


def listener(context):
    path = context.build / "bin/ros2_listener"
    if not path.exists():
        raise Skip("Fast DDS is not there (libfastrtps-dev)")
    return path


def heard(context, topics, run, before_s=1.0, patience_s=4, domain=DOMAIN, variables=""):
    """Output of a listener to a run that starts `before_s` after it (before it, if negative)."""
    listen = f"{listener(context)} {domain} {patience_s} {' '.join(topics)} > heard.txt"
    play = f"{variables} {context.tagfield} run {run} --ros2 --domain {DOMAIN} --no-page --out out > said.txt 2>&1"
    if before_s > 0:
        script = f"({listen}) & sleep {before_s}; {play}; code=$?; wait; exit $code"
    else:
        script = f"({play}) & playing=$!; sleep {-before_s}; {listen}; wait $playing"
    done = in_own_network(context, script)
    said = (context.folder / "said.txt").read_text(encoding="utf-8")
    check_equal(done.returncode, 0, f"exit code ({said})")
    lines = (context.folder / "heard.txt").read_text(encoding="utf-8").splitlines()
    return [json.loads(line) for line in lines]


def messages(lines, topic):
    return [Cdr(line["cdr"]) for line in lines if line["kind"] == "message" and line["topic"] == topic]


@case
def every_read_arrives_in_another_dds(context):
    lines = heard(context, [READS, CLOCK], f"{context.shipped('two_antennas')} --speed 15")
    got = [read for cdr in messages(lines, "rt/rfid/reads") for read in tag_reads(cdr)]
    rows = read_csv(context.folder / "out/reads.csv")
    check_equal(len(got), len(rows), "number of reads")
    expected = sorted((float(row["stamp_s"]), row["antenna"], row["tag"]) for row in rows)
    check(sorted((round(stamp, 9), antenna, epc) for stamp, antenna, epc, *_ in got) == expected,
          "stamps, antennas and tags are not those of reads.csv")
    by_read = {(float(row["stamp_s"]), row["antenna"], row["tag"]): row for row in rows}
    for stamp, antenna, epc, phase, rssi, frequency in got:
        row = by_read[(round(stamp, 9), antenna, epc)]
        if not check(abs(phase - float(row["phase_rad"])) < 1e-6 and rssi == float(row["rssi_dbm"])
                     and frequency == float(row["frequency_hz"]), f"a read of {epc} differs"):
            break
    clock = [cdr.stamp() for cdr in messages(lines, "rt/clock")]
    check(len(clock) > 100 and clock == sorted(clock), "the clock stands or falls")


@case
def those_who_come_late_get_what_is_latched(context):
    lines = heard(context, [TAGS, STATIC_TF], f"{context.shipped('two_antennas')} --speed 12",
                  before_s=-4.0)
    tags = messages(lines, "rt/rfid/truth/tags")
    check_equal(len(tags), 1, "messages of the tags")
    for cdr in tags:
        check_equal(cdr.header()[1], "map", "frame of the tags")
        check_equal(cdr.number("I"), 10, "tags")
    frames = messages(lines, "rt/tf_static")
    check_equal(len(frames), 1, "messages of frames at rest")
    for cdr in frames:
        cdr.number("I")
        check_equal((cdr.header()[1], cdr.text()), ("map", "fixed"), "frame and its child")


@case
def the_map_reaches_those_who_come_late(context):
    lines = heard(context, [MAP, ROBOT_SCAN], f"{context.shipped('paper_warehouse_slam')} --set "
                  "navigation.mapping.limit_s=2 --set duration_s=6 --set localization.method=hyperbola",
                  before_s=-4.0, patience_s=40 if "TAGFIELD_SANITIZED" in os.environ else 4)
    maps = messages(lines, "rt/map")
    check_equal(len(maps), 1, "maps")
    for cdr in maps:
        check_equal(cdr.header()[1], "map", "frame of the map")
        cdr.stamp()
        resolution, width, height = cdr.number("f"), cdr.number("I"), cdr.number("I")
        check(abs(resolution - 0.05) < 1e-8, f"resolution {resolution}")
        pose = [cdr.number("d") for _ in range(7)]
        check_equal((pose[2], pose[3:]), (0.0, [0.0, 0.0, 0.0, 1.0]), "height and turn of the map")
        check_equal(cdr.number("I"), width * height, "cells")
        check_equal(cdr.at + width * height, len(cdr.data), "bytes of the message")
        cells = struct.unpack(f"{width * height}b", cdr.data[cdr.at:])
        check(-1 in cells and max(cells) > 64 and -1 <= min(cells), "cells of no map")
    frames_of_scans = {cdr.header()[1] for cdr in messages(lines, "rt/p3at/scan")}
    check_equal(frames_of_scans, {"p3at/laser"}, "frame of the scans")


@case
def it_is_a_node_of_the_graph(context):
    lines = heard(context, [GRAPH], f"{context.shipped('two_antennas')} --speed 15")
    users = [line["user_data"] for line in lines if line["kind"] == "participant"]
    check_in("enclave=/;", users, "user data of participants")
    writers = {line["topic"]: line for line in lines if line["kind"] == "writer"}
    for topic in ("rt/rfid/reads", "rt/tf", "rt/clock", "rt/rfid/markers", "rt/rfid/truth/antennas"):
        if check(topic in writers, f"no writer of {topic}"):
            check_in("typehash=RIHS01_", writers[topic]["user_data"], f"user data of {topic}")
    cdr = messages(lines, "ros_discovery_info")[-1]
    cdr.at += 16
    check_equal(cdr.number("I"), 1, "nodes")
    check_equal((cdr.text(), cdr.text()), ("/", "tagfield"), "namespace and name")
    check_equal(cdr.number("I"), 0, "readers")
    check_equal(cdr.number("I"), len(writers) - 1, "writers, but for the graph's own")


@case
def listeners_without_multicast_are_found_on_this_machine(context):
    for variables in ("", "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST", "ROS_LOCALHOST_ONLY=1"):
        lines = heard(context, [READS], f"{context.shipped('two_antennas')} --speed 15 --set duration_s=15",
                      domain=f"{DOMAIN}:local", variables=variables)
        got = [read for cdr in messages(lines, "rt/rfid/reads") for read in tag_reads(cdr)]
        total = len(read_csv(context.folder / "out/reads.csv"))
        # If only the listener searches on this machine, it is discovered at its next announcement.
        check(len(got) == total if variables else 0 < len(got) <= total,
              f"{len(got)} of {total} reads with '{variables}'")


@case
def on_this_machine_alone_nothing_goes_to_the_network(context):
    sent = {}
    for name, variables in (("subnet", ""), ("local", "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST")):
        # A network without other members, to count packets sent to it.
        done = in_own_network(
            context, "ip route del 224.0.0.0/4 dev lo && ip link add far type veth peer name near && "
            "ip link set near up && ip link set far addrgenmode none multicast on up && "
            "ip address add 10.1.2.3/24 dev far && "
            f"{variables} {context.tagfield} run {context.shipped('two_antennas')} --ros2 --domain {DOMAIN} "
            "--speed 0 --set duration_s=2 --no-page --out out > /dev/null && cat /proc/self/net/dev")
        check_equal(done.returncode, 0, f"exit code ({done.stderr})")
        row = next(line for line in done.stdout.splitlines() if line.strip().startswith("far:"))
        sent[name] = int(row.split(":")[1].split()[9])
    check(sent["subnet"] > 0, "nothing was sent to the subnet")
    check_equal(sent["local"], 0, "packets sent to the network")


@case
def ranges_that_ros2_does_not_know_are_refused(context):
    for value, says in (("EVERYWHERE", "SUBNET, LOCALHOST"), ("OFF", "no node would find")):
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = value
        result = context.run("run", context.shipped("two_antennas"), "--ros2", "--no-page", "--out", "out")
        del os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"]
        check_equal(result.code, 2, f"exit code of {value}")
        check_in(says, result.err, "complaint")
        check_equal(len(result.err.splitlines()), 1, "lines of complaint")


@case
def a_listener_that_dies_does_not_stop_the_run(context):
    script = (f"timeout --signal KILL 2 {listener(context)} {DOMAIN} 60 {READS} > heard.txt & sleep 1; "
              f"{context.tagfield} run {context.shipped('two_antennas')} --ros2 --domain {DOMAIN} "
              "--speed 20 --no-page --out out")
    begin = time.monotonic()
    done = in_own_network(context, script)
    check_equal(done.returncode, 0, f"exit code ({done.stderr})")
    check(time.monotonic() - begin < 60, "the run stood still")


@case
def bad_domains_and_no_network(context):
    run = ["run", context.shipped("two_antennas"), "--no-page", "--out", "out"]
    # CLI11 writes "0 to 232" or, since Debian 13, "[0 - 232]".
    for arguments, says in ((["--ros2", "--domain", "233"], "0 to 232"),
                            (["--ros2", "--domain", "-1"], "--domain"),
                            (["--domain", "3"], "--ros2"), (["--speed", "-1"], "--speed")):
        result = context.run(*run, *arguments)
        check_equal(result.code, 2, f"exit code of {arguments}")
        check_in(says, result.err.replace("[0 - 232]", "0 to 232"), f"complaint of {arguments}")
    os.environ["ROS_DOMAIN_ID"] = "many"
    result = context.run(*run, "--ros2")
    del os.environ["ROS_DOMAIN_ID"]
    check_equal(result.code, 2, "exit code with a bad ROS_DOMAIN_ID")
    check_in("ROS_DOMAIN_ID is 'many'", result.err, "complaint")
    script = f"ip link set lo down; {' '.join(str(word) for word in [context.tagfield, *run])} --ros2"
    done = in_own_network(context, script)
    check_equal(done.returncode, 2, "exit code without a network")
    check_equal(len(done.stderr.splitlines()), 1, "lines of complaint")
    check_in("can't join domain 0", done.stderr, "complaint")
    check(not (context.folder / "out/reads.csv").exists(), "reads.csv is there")


ROBOT = """\
name: driven
model: paper
time_step_s: 0.01
duration_s: 12
world: {path: WORLD}
robots: [{name: cart, start: [0, 0, 0]}]
antennas: [{name: mast, on: cart, pose: [0.1, 0, 1.2]}]
tags: [{id: t, position: [2, 1, 1]}]
"""
ODOM = "rt/odom=nav_msgs::msg::dds_::Odometry_"
SCAN = "rt/scan=sensor_msgs::msg::dds_::LaserScan_:best_effort"
TF = "rt/tf=tf2_msgs::msg::dds_::TFMessage_"


def odometry(cdr):
    """stamp, x, y, forward speed, variance of x of an Odometry."""
    stamp, frame = cdr.header()
    check_equal((frame, cdr.text()), ("odom", "base_link"), "frame and its child")
    pose = [cdr.number("d") for _ in range(7)]
    covariance = [cdr.number("d") for _ in range(36)]
    return stamp, pose[0], pose[1], cdr.number("d"), covariance[0]


def frames(cdr):
    """(parent, child, x, z) of each transform of a TFMessage."""
    found = []
    for _ in range(cdr.number("I")):
        parent, child = cdr.header()[1], cdr.text()
        place = [cdr.number("d") for _ in range(7)]
        found.append((parent, child, place[0], place[2]))
    return found


@case
def a_robot_is_driven_from_another_dds(context):
    world = context.source.resolve() / "worlds/small_warehouse.sdf"
    scenario = context.write("driven.yaml", ROBOT.replace("WORLD", str(world)))
    topics = " ".join([ODOM, SCAN, TF, CLOCK])
    listen = f"{listener(context)} {DOMAIN} 5 {topics} > heard.txt"
    # Driven from 3 s of the run on for 2 s by one node, then for 2 s by another with stamped commands.
    driver = f"{context.build / 'bin/ros2_driver'} {DOMAIN} 2 0.5 0"
    drive = f"sleep 4; {driver}; sleep 1; {driver} stamped"
    done = in_own_network(
        context, f"({listen}) & ({drive}) & sleep 1; {context.tagfield} run {scenario} --ros2 --domain "
        f"{DOMAIN} --drive cart --mcap run.mcap --no-page --out out > said.txt 2>&1; code=$?; wait; exit $code")
    said = (context.folder / "said.txt").read_text(encoding="utf-8")
    check_equal(done.returncode, 0, f"exit code ({said})")
    lines = [json.loads(line) for line in
             (context.folder / "heard.txt").read_text(encoding="utf-8").splitlines()]
    rows = [odometry(cdr) for cdr in messages(lines, "rt/odom")]
    if not check(len(rows) > 300, f"{len(rows)} messages of odometry"):
        return
    check_equal(rows[0][1:4], (0.0, 0.0, 0.0), "where it starts")
    check(1.2 < rows[-1][1] < 2.6, f"it drove {rows[-1][1]} m, expected about 4 s at 0.5 m/s")
    check(abs(rows[-1][2]) < 0.1, f"it strayed by {rows[-1][2]} m")
    # Wheel noise over 20 ms at 0.5 m/s is 0.05 m/s (navigation.odometry, alpha3): a bound of six sigma.
    check(0.4 < max(row[3] for row in rows) < 0.8, "greatest speed")
    check_equal(rows[-1][3], 0.0, "speed once nobody drives any more")
    starts = sum(before[3] == 0.0 != row[3] for before, row in zip(rows, rows[1:]))
    check_equal(starts, 2, "times that it drove off: commands without stamps, and with")
    # The integral of the odometry's speed is the distance; its variance is stated.
    check(abs(sum(row[3] * (row[0] - before[0]) for before, row in zip(rows, rows[1:])) - rows[-1][1]) < 0.02,
          "the speeds do not add up to the distance")
    check_equal(rows[0][4], 0.0, "variance of x where it starts")
    # alpha3²·d = 1e-4·d along the path, for some 2 m.
    check(0.7 < rows[-1][4] / (1e-4 * rows[-1][1]) < 1.5, f"variance of x {rows[-1][4]} after {rows[-1][1]} m")
    truth = [row for row in read_csv(context.folder / "out/truth/robot_poses.csv")]
    check(abs(float(truth[-1]["x_m"]) - rows[-1][1]) < 0.1, "the odometry is not near the truth")
    scans = messages(lines, "rt/scan")
    check(len(scans) > 100, f"{len(scans)} scans")
    # A few scans may have a time missing from the clock topic, which is best effort.
    clock = {round(cdr.stamp(), 6) for cdr in messages(lines, "rt/clock")}
    stamps = {round(cdr.header()[0], 6) for cdr in messages(lines, "rt/scan")}
    check(len(stamps - clock) < 0.1 * len(stamps), f"{len(stamps - clock)} scans of {len(stamps)} before their time")
    cdr = scans[-1]
    check_equal(cdr.header()[1], "laser", "frame of the scans")
    limits = [cdr.number("f") for _ in range(7)]
    ranges = [cdr.number("f") for _ in range(cdr.number("I"))]
    check_equal(len(ranges), 720, "beams")
    check_equal([round(limit, 6) for limit in limits[5:]], [0.3, 30.0], "nearest and farthest range")
    check(any(limits[5] <= value <= limits[6] for value in ranges), "no beam met anything")
    frame_pairs = {frame[:2] for cdr in messages(lines, "rt/tf") for frame in frames(cdr)}
    check_equal(frame_pairs, {("odom", "base_link"), ("base_link", "mast")}, "frames")
    # Topics are uncompressed in the file's summary section.
    recorded = (context.folder / "run.mcap").read_bytes()
    for topic in (b"/odom", b"/scan", b"/tf", b"/tf_static", b"/rfid/reads"):
        check_in(struct.pack("<I", len(topic)) + topic, recorded, "the recording")


@case
def a_robot_is_driven_in_one_run_and_believes_its_wheels(context):
    for option in (["--seeds", "2"], ["--breakdown"]):
        result = context.run("run", context.shipped("two_antennas"), "--ros2", "--drive", "p3at", *option)
        check_equal(result.code, 2, f"exit code with {option[0]}")
        check_in(option[0], result.err, "complaint")
    # Regardless of the scenario's pose source: in this one the robot would map the hall autonomously.
    done = in_own_network(
        context, f"{context.tagfield} run {context.shipped('paper_warehouse_slam')} --ros2 --speed 10 "
        "--drive p3at --set duration_s=1 --no-page --out out")
    check_equal(done.returncode, 0, f"exit code ({done.stderr})")
    check_equal(read_json(context.folder / "out/summary.json")["pose"], "odometry", "pose")
    check(not (context.folder / "out/map.pgm").exists(), "a map that nobody made")


@case
def a_robot_that_is_not_there_is_not_driven(context):
    result = context.run("run", context.shipped("two_antennas"), "--ros2", "--drive", "p3at2", "--out",
                         "out")
    check_equal(result.code, 2, "exit code")
    check_in("there is no robot 'p3at2' to be driven (did you mean 'p3at'?)", result.err, "complaint")


GENERATE_CPP = "import sys; from rosidl_generator_cpp import generate_cpp; generate_cpp(sys.argv[1])"
USE_MESSAGES = """\
#include <tagfield_msgs/msg/antenna_truth.hpp>
#include <tagfield_msgs/msg/tag_positions.hpp>
#include <tagfield_msgs/msg/tag_reads.hpp>
int main() {
  tagfield_msgs::msg::TagReads message;
  message.reads.resize(1);
  message.reads[0].header.frame_id = "a";
  message.reads[0].epc = "E2";
  message.reads[0].phase = message.reads[0].rssi = message.reads[0].doppler = 1.0;
  tagfield_msgs::msg::TagPositions tags;
  tags.tags.resize(1);
  tags.tags[0].position.z = 1.0;
  tagfield_msgs::msg::AntennaTruth truth;
  truth.pose.orientation.w = truth.distances.emplace_back(1.0);
  return message.reads[0].doppler == tags.tags[0].position.z ? 0 : 1;
}
"""


@case
def ros2s_own_generator_takes_the_messages(context):
    if not pathlib.Path("/usr/share/rosidl_generator_cpp/resource").exists():
        raise Skip("rosidl is not there (python3-rosidl, rosidl-generator-c-cpp)")
    adapters = context.source.resolve() / "adapters"
    packages = {}
    for path in (*adapters.glob("ros2/interfaces/*/msg/*.msg"),
                 *adapters.glob("tagfield_msgs/msg/*.msg")):
        packages.setdefault(path.parent.parent, []).append(path.stem)

    def made(*command):
        done = subprocess.run(["/usr/bin/python3", *command], capture_output=True, text=True, check=False)
        check_equal(done.returncode, 0, f"exit code of {command[:2]} ({done.stderr[-300:]})")

    for folder, names in packages.items():
        idl = context.folder / "idl" / folder.name
        arguments = context.write(f"{folder.name}.json", json.dumps(
            {"non_idl_tuples": [f"{folder}:msg/{name}.msg" for name in names]}))
        made("-m", "rosidl_adapter", "--package-name", folder.name, "--arguments-file", arguments,
             "--output-dir", idl, "--output-file", context.folder / "list")
        arguments = context.write(f"{folder.name}_cpp.json", json.dumps(
            {"package_name": folder.name, "idl_tuples": [f"{idl}:msg/{name}.idl" for name in names],
             "ros_interface_dependencies": [], "target_dependencies": [],
             "output_dir": str(context.folder / "cpp" / folder.name),
             "template_dir": "/usr/share/rosidl_generator_cpp/resource"}))
        made("-c", GENERATE_CPP, arguments)
    source = context.write("use.cc", USE_MESSAGES)
    includes = [f"-I/usr/include/{name}" for name in
                ("rosidl_runtime_cpp", "rosidl_runtime_c", "rosidl_typesupport_interface")]
    done = subprocess.run(["c++", "-std=c++17", "-I", context.folder / "cpp", *includes, source, "-o",
                           context.folder / "use"], capture_output=True, text=True, check=False)
    if check_equal(done.returncode, 0, f"exit code of the compiler ({done.stderr[:600]})"):
        check_equal(subprocess.run([context.folder / "use"], check=False).returncode, 0, "its result")


if __name__ == "__main__":
    main()
