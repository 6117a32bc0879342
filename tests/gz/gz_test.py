#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tagfield in a real gz-sim: the same reads as headless, and nothing crashes the server."""

import json
import math
import os
import re
import subprocess

from gz import (
    Skip, antenna, case, check, check_equal, check_in, check_near, errors, main,
    model, read_csv, recorded, require_server, sensor, serve, tag, world)
from hall import SECONDS, headless, reads_in, scenario


def moving():
    """Motion of the cart and one tag, with a pose every 20 ms, as in the test of Gazebo 11."""
    lines = []
    for step in range(int(SECONDS / 0.02)):
        now = 0.02 * step
        lines.append(f"pose cart {-3 + 0.6 * now} {4 - 0.15 * now} 1 -0.6")
        if now >= 1.0:
            lines.append(f"pose mover {-2 + 0.8 * (now - 1)} {4.5 - 0.4 * (now - 1)} 1.2 0")
        lines.append("run 0.02")
    return lines


def check_parity(context, kind, settings, least):
    """Checks that replaying gz-sim's poses headless gives the same reads byte for byte."""
    # DART, gz-sim's physics engine, rejects mirrored meshes; the paper's model has no transmit power.
    cart = "" if kind == "paper" else "transmit_power_dbm: 27, "
    path = scenario(context, kind, settings, scale="1.5 1 2", cart=cart)
    sdf = context.folder / f"{kind}.sdf"
    mcap = context.folder / f"{kind}.mcap"
    context.run_well("gazebo", path, "--gz", "--mcap", mcap, "--real-time", 0, "--out", sdf)
    said = serve(context, sdf.read_text(encoding="utf-8"), moving())
    check_equal(errors(said), [], "errors")
    run = context.folder / "located"
    context.run_well("localize", mcap, "--scenario", path, "--out", run)
    expected = reads_in(run)
    actual = reads_in(headless(context, path, run))
    check(len(expected) >= least, f"only {len(expected)} reads")
    check_equal({read[2] for read in expected}, {"gate", "cart"}, "antennas that read")
    check("mover" in {read[3] for read in expected}, "the tag that moves was never read")
    check(len(actual) == len(expected), f"{len(actual)} reads in the replay, {len(expected)} here; "
          f"in one alone: {sorted(set(expected) ^ set(actual))[:3]}")
    differing = [pair for pair in zip(expected, actual) if pair[0] != pair[1]]
    check(not differing, f"{len(differing)} of {len(expected)} reads differ, as {differing[:2]}")


@case
def the_papers_model_is_the_same(context):
    check_parity(context, "paper", "range_m: 6", 500)


@case
def the_link_budget_with_inventory_is_the_same(context):
    check_parity(context, "link_budget", "channel_plan: etsi_low, inventory: gen2", 300)


@case
def multipath_of_order_two_is_the_same(context):
    check_parity(context, "multipath", "reflection_order: 2, channel_plan: fcc", 500)


@case
def sensors_come_move_and_go(context):
    """A tag is inserted at 1 s, moves at 2 s and is removed at 3 s; an antenna is inserted at 2 s."""
    new_tag = context.write("tag.sdf", f'<sdf version="1.8">{tag("late", 3, 0, 1)}</sdf>')
    new_gate = context.write("gate.sdf", f'<sdf version="1.8">{antenna("second", 0, 2, 1)}</sdf>')
    serve(context, world(antenna("gate", 0, 0, 1), tag("first", 2, 0, 1)),
          ["run 1", f"create {new_tag}", "run 1", "pose late 4 0 1 0", f"create {new_gate}",
           "run 1", "remove late", "run 1"])
    folder = recorded(context)
    reads = read_csv(folder / "reads.csv")
    stamps = [float(read["stamp_s"]) for read in reads if read["tag"] == "late"]
    check(stamps and 1.0 <= min(stamps) <= 1.07 and 2.9 <= max(stamps) <= 3.002,
          f"read from {min(stamps, default=None)} s to {max(stamps, default=None)} s")
    second = [float(read["stamp_s"]) for read in reads if read["antenna"] == "second"]
    check(second and 2.0 <= min(second) <= 2.07, f"the antenna reads from {min(second, default=None)}")
    first = [read for read in reads if read["tag"] == "first" and read["antenna"] == "gate"]
    check(abs(len(first) - 60) <= 1, f"{len(first)} reads of the first tag in 4 s")
    for row in read_csv(folder / "truth/distances.csv"):
        if row["tag"] == "late" and row["antenna"] == "gate":
            wanted = 3.0 if float(row["stamp_s"]) <= 2.0005 else 4.0
            check_near(float(row["distance_m"]), wanted, 1e-9, f"distance at {row['stamp_s']}")


@case
def a_wrong_parameter_is_one_error_and_the_rest_goes_on(context):
    said = serve(context, world(
        antenna("gate", 0, 0, 1), tag("good", 2, 0, 1),
        antenna("far", 0, 0, 1, "<range>far</range>"),
        tag("twice", 2, 1, 1, "<epc>good</epc>"),
        model("odd", "0 0 0 0 0 0", sensor("odd", "rfid_gate")),
        model("shelf", "0 0 0 0 0 0", sensor("set", "rfid_tag_set", '<tag epc="x">1 2</tag>')),
        model("rack", "0 0 0 0 0 0", sensor("set", "rfid_tag_set", "<table>none.csv</table>")),
        settings="<domain>400</domain>"), ["run 1"])
    found = errors(said)
    for part in ("model 'far', link 'link', sensor 'far': <range> is 'far', expected a number; "
                 "stays off",
                 "model 'twice', link 'link', sensor 'tag':",
                 "gz:type is 'rfid_gate', expected rfid_antenna, rfid_tag or rfid_tag_set",
                 "model 'shelf', link 'link', sensor 'set':",
                 "model 'rack', link 'link', sensor 'set': <table> 'none.csv' is not found",
                 "<domain> is '400', expected a whole number from 0 to 232"):
        check_equal(len([line for line in found if part in line]), 1, f"errors with {part!r}")
    check_equal(len(found), 6, f"errors, of {found}")
    check(not [line for line in found if ".h:" in line and "[Err]" in line],
          f"a place in our sources stands in one of {found}")
    check("<mcap>" not in said and "<ros2>" not in said, "its own elements are taken for materials")
    check(not (context.folder / "run.mcap").exists(), "a wrong domain was given, and it recorded")
    check("wall " in said, "the server did not live")


@case
def settings_without_effect_are_warned_of(context):
    said = serve(context, world(
        model("gate", "0 0 1 0 0 0", sensor("gate", "rfid_antenna", "<rnge>3</rnge>",
                                            "<topic>mine</topic>")),
        settings="<made_off>metal</made_off><clock>true</clock>"), ["run 0.1"])
    for part in ("rnge", "<domain> and <clock> have no effect without <ros2>",
                 "<topic> has no effect: reads are on /rfid/reads", "<made_off>"):
        check_in(part, said, "what the server said")


@case
def a_reset_begins_anew(context):
    """The first second twice: after a reset, antennas update at the same stamps again."""
    said = serve(context, world(antenna("gate", 0, 0, 1), tag("first", 2, 0, 1)),
                 ["run 1", "run 0.5", "reset", "run 1"])
    check_equal(errors(said), [], "errors")
    folder = context.folder / "located"
    result = context.run_well("localize", context.folder / "run.mcap", "--tag-height", "1", "--out",
                              folder)
    repeated = re.search(r"(\d+) reads repeat the stamp, antenna and tag", result.err)
    check(repeated and int(repeated.group(1)) in (14, 15), f"{result.err!r} tells of no second run")
    stamps = [float(read["stamp_s"]) for read in read_csv(folder / "reads.csv")]
    check(1.4 < max(stamps) < 1.51, f"the first run lasted until {max(stamps)} s")


@case
def time_goes_back_and_reads_go_on(context):
    """A jump from 3 s to 1 s: antennas update from there on, and tags inserted later still exist."""
    late = context.write("tag.sdf", f'<sdf version="1.8">{tag("late", 3, 0, 1)}</sdf>')
    said = serve(context, world(antenna("gate", 0, 0, 1), tag("first", 2, 0, 1)),
                 ["run 2", f"create {late}", "run 1", "seek 1", "run 3"])
    check_equal(errors(said), [], "errors")
    folder = context.folder / "located"
    result = context.run_well("localize", context.folder / "run.mcap", "--tag-height", "1", "--out",
                              folder)
    # Reads of 2 s with the first tag, of which 1 s with both.
    repeated = re.search(r"(\d+) reads repeat the stamp, antenna and tag", result.err)
    check(repeated and 40 <= int(repeated.group(1)) <= 46, f"{result.err!r} tells of no way back")
    stamps = [float(read["stamp_s"]) for read in read_csv(folder / "reads.csv")
              if read["tag"] == "late"]
    check(1.0 <= min(stamps) <= 1.07 and 3.9 <= max(stamps) <= 4.002,
          f"the tag that came is read from {min(stamps)} s to {max(stamps)} s")


@case
def gazebos_own_topics_and_its_window_get_messages(context):
    """Late subscribers receive the messages, too, also of tags that do not move."""
    said = serve(context, world(antenna("gate", 0, 0, 1, "<range>5</range>"), tag("near", 2, 0, 1),
                                tag("far", 20, 0, 1)),
                 ["run 1", "hear /rfid/reads", "hear /rfid/truth/antennas", "hear /rfid/truth/tags",
                  "hear /rfid/truth/tags_moved", "window", "run 3", "pose far 21 0 1 0", "run 1"])
    heard = {topic: (kind, int(count)) for topic, kind, count in
             re.findall(r"^heard (\S+) (\S+) (\d+)$", said, re.MULTILINE)}
    for topic, kind, least, most in (
            ("/rfid/reads", "TagReads", 59, 61), ("/rfid/truth/antennas", "AntennaTruth", 59, 61),
            ("/rfid/truth/tags", "TagPositions", 4, 5), ("/rfid/truth/tags_moved", "TagPositions", 1, 1)):
        found, count = heard.get(topic, ("nothing", 0))
        check_equal(found, f"tagfield.msgs.{kind}", topic)
        check(least <= count <= most, f"{count} messages on {topic}")
    shown = re.findall(r"^marker (\S+) \d+ (\d+)$", said, re.MULTILINE)
    check_equal(sorted(name for name, _ in shown),
                ["tagfield_antennas"] * 2 + ["tagfield_tags"] * 2, "markers: arrow, ball, two shades")
    check_equal({points for name, points in shown if name == "tagfield_tags"}, {"24"}, "points of a tag")


@case
def names_are_those_of_gazebo_11(context):
    """IDs of tags without an EPC, and antennas of one name."""
    two = sensor("left", "rfid_tag") + sensor("right", "rfid_tag", "<epc>E28011</epc>")
    gates = [model(name, f"0 {y} 1 0 0 0", sensor("antenna", "rfid_antenna", "<range>50</range>",
                                                   prefix=prefix))
             for name, y, prefix in (("north", 1, "gz"), ("south", -1, "ignition"))]
    serve(context, world(*gates, tag("alone", 2, 0, 1), model("pair", "3 0 1 0 0 0", two)),
          ["run 0.5"])
    reads = read_csv(recorded(context) / "reads.csv")
    check_equal({read["tag"] for read in reads}, {"alone", "pair::left", "E28011"}, "IDs")
    check_equal({read["antenna"] for read in reads}, {"antenna", "south::antenna"}, "antennas")


@case
def a_table_of_thousands_moves_with_its_link(context):
    count = 5000
    rows = "".join(f"t{i},{0.001 * (i % 100)},{0.001 * (i // 100)},0\n" for i in range(count))
    table = context.write("tags.csv", f"epc,x_m,y_m,z_m\n{rows}")
    shelf = model("shelf", "2 0 1 0 0 0",
                  sensor("set", "rfid_tag_set", f"<table>file://{table}</table>"))
    serve(context, world(antenna("gate", 0, 0, 1), shelf), ["run 0.2", "pose shelf 5 0 1 0", "run 0.2"])
    rows = read_csv(recorded(context) / "truth/distances.csv")
    check_equal(len({row["tag"] for row in rows}), count, "tags read")
    for row in rows:
        if row["tag"] == "t0":
            check_near(float(row["distance_m"]), 2.0 if float(row["stamp_s"]) <= 0.2005 else 5.0,
                       1e-9, f"distance at {row['stamp_s']}")


@case
def the_robot_drives_its_way_and_tags_are_located(context):
    """The paper's warehouse with gz-sim's physics, wheels and DiffDrive."""
    sdf, mcap = context.folder / "warehouse.sdf", context.folder / "warehouse.mcap"
    path = context.shipped("paper_warehouse")
    context.run_well("gazebo", path, "--gz", "--mcap", mcap, "--stop-at-end", "--real-time", 0,
                     "--out", sdf)
    serve(context, sdf.read_text(encoding="utf-8"), ["run 200"])
    folder = context.folder / "located"
    context.run_well("localize", mcap, "--scenario", path, "--out", folder)
    rows = read_csv(folder / "estimates.csv")
    check_equal(len(rows), 10, "tags")
    for row in rows:
        check_equal(row["verdict"], "located", f"verdict on {row['tag']}")
    last = float(read_csv(folder / "reads.csv")[-1]["stamp_s"])
    check(last < 150.0, f"the robot drove {last} s, and did not stop at the end")


@case
def ros_2_hears_the_reads_without_a_bridge(context):
    """Fast DDS, in a separate network namespace with the server, receives one message per update."""
    listener = context.build / "bin/ros2_listener"
    if not listener.exists():
        raise Skip("Fast DDS is not there (libfastrtps-dev)")
    own = ["unshare", "--net"] if os.geteuid() == 0 else ["unshare", "--net", "--map-root-user"]
    if subprocess.run([*own, "true"], capture_output=True, check=False).returncode != 0:
        raise Skip("no network of one's own can be had")
    topic = "rt/rfid/reads=tagfield_msgs::msg::dds_::TagReads_"
    clock = "rt/clock=rosgraph_msgs::msg::dds_::Clock_:best_effort"
    listen = (f"ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo; "
              f"{listener} 7 4 {topic} {clock} > heard.txt & sleep 1; \"$@\"; code=$?; wait; exit $code")
    text = world(antenna("gate", 0, 0, 1), tag("first", 2, 0, 1), settings="<domain>7</domain>")
    text = text.replace("<ros2>false</ros2>", "<ros2>true</ros2>")
    text = text.replace("<real_time_factor>0<", "<real_time_factor>1<")
    serve(context, text, ["run 3"], [*own, "sh", "-c", listen, "sh"])
    heard = [json.loads(line) for line in
             (context.folder / "heard.txt").read_text(encoding="utf-8").splitlines()]
    reads = [line for line in heard if line["kind"] == "message" and "rfid/reads" in line["topic"]]
    # Discovery may take some of the 45 updates.
    check(20 <= len(reads) <= 45, f"{len(reads)} messages of reads")
    for line in reads:
        check("first".encode().hex() in line["cdr"], f"no read of the tag in {line['cdr'][:80]}")
    check(not [line for line in heard if line["kind"] == "message" and "clock" in line["topic"]],
          "/clock is sent, which a bridge does")


@case
def our_models_are_found_and_read(context):
    """Models by `model://`: a set of tags with its table, a tag, an antenna, a robot with DiffDrive."""
    def include(name, pose):
        return f"<include><uri>model://{name}</uri><pose>{pose}</pose></include>"
    said = serve(context, world(include("rfid_antenna", "0 0 1 0 0 0"),
                                include("rfid_tag", "2 0 1 0 0 0"),
                                include("rfid_tag_set", "3 0 0 0 0 0"),
                                include("p3at_rfid", "5 5 0 0 0 0")), ["run 1"])
    check_equal(errors(said), [], "errors")
    reads = read_csv(recorded(context) / "reads.csv")
    check_equal(len({read["antenna"] for read in reads}), 2, "antennas that read")
    check_equal(len({read["tag"] for read in reads}), 25, "tags read")


@case
def a_world_of_gazebo_11_is_read_after_its_conversion(context):
    old = context.write("old.world", '''<?xml version="1.0"?><sdf version="1.6"><world name="hall">
      <plugin name="materials" filename="libTagfieldMaterialsPlugin.so"><made_of name="rack*">metal</made_of></plugin>
      <plugin name="gone" filename="libgazebo_ros_factory.so"/>
      <model name="gate"><static>1</static><pose>0 0 1 0 0 0</pose><link name="link">
        <sensor name="gate" type="rfid"><update_rate>15</update_rate>
          <plugin name="a" filename="libgazeboRfidAntennaPlugin.so"><range>50</range></plugin></sensor></link></model>
      <model name="tag1"><static>1</static><pose>3 0.5 1 0 0 0</pose><link name="link">
        <sensor name="tag" type="rfidtag"><plugin name="t" filename="libgazeboRfidTagPlugin.so"/></sensor></link></model>
      <model name="shelf"><static>1</static><pose>3 1 1 0 0 0</pose><link name="a"/><link name="b"><pose>0 1 0 0 0 0</pose></link>
        <plugin name="tags" filename="libTagfieldTagSetPlugin.so"><link>b</link><tag epc="on_b">0 0 0</tag></plugin></model>
      </world></sdf>''')
    result = context.run_well("gazebo", old, "--gz", "--mcap", "run.mcap", "--out", "new.sdf")
    check_in("old.world:3", result.err, "the warning of a plugin that is left out")
    said = serve(context, (context.folder / "new.sdf").read_text(encoding="utf-8"), ["run 0.5"])
    check_equal(errors(said), [], "errors")
    rows = read_csv(recorded(context) / "truth/distances.csv")
    distances = {row["tag"]: float(row["distance_m"]) for row in rows}
    check_equal(set(distances), {"tag1", "on_b"}, "tags read")
    check_near(distances["on_b"], math.hypot(3, 2), 1e-9, "distance of the tag on the second link")


if __name__ == "__main__":
    require_server()
    main()
