# SPDX-License-Identifier: Apache-2.0
"""Tagfield's MCAP files read by @mcap/core, and its files read by Tagfield.

That package is Foxglove's implementation for browsers: an indexed reader, a streaming reader, and a
writer. npm installs it into the build folder.
"""

import json
import pathlib
import random
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "command"), str(HERE.parent / "live")]
from common import (  # noqa: E402  pylint: disable=wrong-import-position
    Skip, case, check, check_equal, check_in, main, read_csv, run)
from npm import npm_packages  # noqa: E402  pylint: disable=wrong-import-position
from served import served  # noqa: E402  pylint: disable=wrong-import-position

START_NS = 1_700_000_000_000_000_000
TOPICS = ("/text", "/pose", "/text/größer")  # of messages 0, 1, 2, 3, …
# Compression, chunk size in bytes, number of messages.
FILES = (("none", 1, 10), ("none", 3000, 1000), ("lz4", 3000, 1000), ("zstd", 3000, 1000),
         ("zstd", 1 << 20, 100_000), ("lz4", 1 << 20, 0))


def others(context, *words):
    return run(["node", HERE / "others.mjs", npm_packages(context.build, HERE, "mcap"), *words], cwd=context.folder)


def read_by_others(context, *words):
    """Content of a file read by @mcap/core; None, and a failed check, if it rejects the file."""
    result = others(context, *words)
    if not check(result.code == 0, f"@mcap/core refuses it: {result.err.strip()[:500]}"):
        return None
    return json.loads(result.out)


def ours(context, *words):
    sample = context.build / "bin/mcap_sample"
    if not sample.exists():
        raise Skip("mcap_sample is not built (TAGFIELD_MCAP, liblz4-dev, libzstd-dev)")
    result = run([sample, *words], cwd=context.folder)
    check(result.code == 0, f"mcap_sample {words}: {result.err.strip()}")
    return result


def write_sample(context, compression, chunk_bytes, count):
    path = context.folder / f"{compression}.mcap"
    ours(context, "write", path, compression, chunk_bytes, count)
    return path


def sample_messages(count):
    """Messages that mcap_sample writes, in order: channel, sequence, log time, publish time, bytes."""
    messages = []
    for i in range(count):
        sent = START_NS + i * 100_000_000
        logged = sent + 2_000_000_000 if i % 5 == 0 else sent
        messages.append([i % 3 + 1, i // 3, str(logged), str(sent),
                         (bytes([i % 256]) * (i % 50)).hex()])
    return messages


def log_time(message):
    return int(message[2])


def check_definitions(found, what):
    text = {"encoding": "ros2msg", "text": "string data\n", "name": "std_msgs/msg/String", "id": 1}
    point = {"encoding": "ros2msg", "text": "float64 x\nfloat64 y\nfloat64 z\n",
             "name": "geometry_msgs/msg/Point", "id": 2}
    check_equal(found["schemas"], [text, point], f"{what}: schemas")
    expected = [("/text", 1, {"offered_qos_profiles": ""}), ("/pose", 2, {}),
                ("/text/größer", 1, {"a": "1", "b": "2"}), ("/silent", 2, {})]
    check_equal([(channel["topic"], channel["schema"], channel["metadata"])
                 for channel in found["channels"]], expected, f"{what}: channels")
    check_equal([(channel["id"], channel["encoding"]) for channel in found["channels"]],
                [(i, "cdr") for i in (1, 2, 3, 4)], f"{what}: ids and encodings")
    check_equal((found["profile"], found["library"]), ("ros2", "tagfield"), f"{what}: header")


def check_statistics(index, messages, what):
    times = sorted(map(log_time, messages)) or [0]
    check_equal(index["statistics"],
                {"messages": len(messages), "schemas": 2, "channels": 4, "chunks": index["chunks"],
                 "from": str(times[0]), "to": str(times[-1])}, f"{what}: statistics")
    check_equal(index["counts"],
                {str(channel): sum(message[0] == channel for message in messages)
                 for channel in (1, 2, 3, 4)}, f"{what}: counts")


@case
def its_readers_find_what_we_wrote(context):
    for compression, chunk_bytes, count in FILES:
        what = f"{compression}, chunks of {chunk_bytes} bytes, {count} messages"
        path = write_sample(context, compression, chunk_bytes, count)
        found = read_by_others(context, "read", path)
        if found is None:
            continue
        index, stream = found["index"], found["stream"]
        messages = sample_messages(count)
        check_definitions(index, what)
        check_statistics(index, messages, what)
        check(index["messages"] == sorted(messages, key=log_time), f"{what}: messages by index")
        check_equal([log_time(message) for message in index["backward"]],
                    sorted(map(log_time, messages), reverse=True), f"{what}: times backward")
        check(stream["messages"] == messages, f"{what}: messages of the stream")
        check_equal((stream["done"], stream["left"]), (True, 0), f"{what}: end of the stream")
        check(stream["isRightData"], f"{what}: the data's CRC is wrong")
        check_equal(stream["kinds"].get("Chunk", 0), index["chunks"], f"{what}: chunks")
        check((index["chunks"] > 1) == (count > 0), f"{what}: {index['chunks']} chunks")
        check_equal(index["compressions"], [compression.replace("none", "")] if count else [],
                    f"{what}: compression")
        check_equal(index["summaryOffsets"], [3, 4, 11, 8] if count else [3, 4, 11],
                    f"{what}: summary offsets")


@case
def its_index_finds_topics_and_times(context):
    path = write_sample(context, "zstd", 3000, 1000)
    messages = sample_messages(1000)
    for channel, topic in enumerate(TOPICS, 1):
        begin, end = START_NS + 30_000_000_000, START_NS + 45_000_000_000
        expected = [message for message in sorted(messages, key=log_time)
                    if message[0] == channel and begin <= log_time(message) <= end]
        check(len(expected) > 40, f"{topic}: only {len(expected)} messages to find")
        check(read_by_others(context, "query", path, topic, begin, end) == expected,
              f"{topic}: what the index finds")


@case
def its_readers_notice_a_wrong_byte(context):
    """Otherwise, the readers would not have checked the CRCs above."""
    path = write_sample(context, "none", 3000, 1000)
    whole = path.read_bytes()
    text = whole.index(b"float64 x")
    for at, says in ((text, "Incorrect chunk CRC"), (whole.rindex(b"float64 x"), "summary CRC")):
        broken = context.write("broken.mcap", whole[:at] + b"F" + whole[at + 1:])
        result = others(context, "read", broken)
        check_equal(result.code, 1, f"exit code with byte {at} wrong")
        check_in(says, result.err, f"with byte {at} wrong")


@case
def we_read_what_its_writer_wrote(context):
    messages = [[("/a", "/b")[i % 2], i, (i * 37) % 100, i, (bytes([i]) * i).hex()]
                for i in range(100)]
    messages.sort(key=lambda message: message[2])
    for kind in ("none", "zstd", "flat"):
        path = context.folder / f"{kind}.mcap"
        result = others(context, "write", path, kind)
        check_equal(result.code, 0, f"exit code of its writer ({result.err.strip()[:300]})")
        found = ours(context, "read", path)
        check_equal(found.err, "", f"{kind}: warnings")
        lines = [line.split(" ") for line in found.out.splitlines()]
        check_equal(lines[:3], [["ros2"], *([topic, "std_msgs/msg/String", f"key={topic}"]
                                            for topic in ("/a", "/b"))], f"{kind}: channels")
        check(lines[3:] == [[str(word) for word in message] for message in messages],
              f"{kind}: messages")
        # Complete chunks of a truncated file are still read.
        cut = context.write("cut.mcap", path.read_bytes()[:path.stat().st_size // 2])
        found = ours(context, "read", cut)
        check_in("is cut off or broken here", found.err, f"{kind}, cut: warnings")
        left = found.out.splitlines()[3:]
        check(20 < len(left) < 100 and set(left) <= {" ".join(line) for line in lines[3:]},
              f"{kind}, cut: {len(left)} messages")


@case
def a_runs_messages_are_those_of_its_tables(context):
    folder = context.simulate("two_antennas", "--no-page", "--mcap", context.folder / "run.mcap")
    topics = read_by_others(context, "decode", context.folder / "run.mcap")
    if topics is None:
        return
    types = {topic: entry["type"] for topic, entry in topics.items()}
    check_equal(types, {
        "/clock": "rosgraph_msgs/msg/Clock", "/tf": "tf2_msgs/msg/TFMessage",
        "/tf_static": "tf2_msgs/msg/TFMessage", "/rfid/reads": "tagfield_msgs/msg/TagReads",
        "/rfid/markers": "visualization_msgs/msg/MarkerArray",
        "/rfid/truth/antennas": "tagfield_msgs/msg/AntennaTruth",
        "/rfid/truth/tags": "tagfield_msgs/msg/TagPositions",
        "/rfid/truth/tags_moved": "tagfield_msgs/msg/TagPositions",
        "/p3at/ground_truth/odom": "nav_msgs/msg/Odometry"}, "topics and their types")
    for topic, entry in topics.items():
        check_in("reliability: ", entry["metadata"].get("offered_qos_profiles", ""), f"{topic}: QoS")
        check_in("RIHS01_", entry["metadata"].get("topic_type_hash", ""), f"{topic}: hash")
    check_in("durability: 1", topics["/tf_static"]["metadata"]["offered_qos_profiles"], "/tf_static")

    def seconds(stamp):
        return f"{stamp['sec']}.{stamp['nanosec']:09}"

    reads = [[seconds(read["header"]["stamp"]), read["antenna"], read["epc"], read["frequency"],
              read["rssi"], read["phase"], read["doppler"]]
             for message in topics["/rfid/reads"]["messages"] for read in message["reads"]]
    rows = read_csv(folder / "reads.csv")
    check_equal(len(reads), len(rows), "reads")
    expected = {(row["stamp_s"], row["antenna"], row["tag"]):
                (float(row["frequency_hz"]), float(row["rssi_dbm"])) for row in rows}
    check({tuple(read[:3]): tuple(read[3:5]) for read in reads} == expected, "reads differ")
    check({read[6] for read in reads} == {"NaN"}, "a reader that tells no Doppler tells some")
    places = {tag["epc"]: tag["position"] for tag in topics["/rfid/truth/tags"]["messages"][0]["tags"]}
    truth = {row["tag"]: {"x": float(row["x_m"]), "y": float(row["y_m"]), "z": float(row["z_m"])}
             for row in read_csv(folder / "truth/tags.csv")}
    check_equal(places, truth, "positions of tags")
    count = len(read_csv(folder / "truth/distances.csv"))
    check_equal(sum(len(message["distances"]) for message in topics["/rfid/truth/antennas"]["messages"]),
                count, "distances")
    check(topics["/rfid/markers"]["messages"][0]["markers"], "no markers")


def pgm_cells(path):
    """Cells of a map file in the order of messages, from the lower left corner on."""
    without_comment = re.sub(rb"#[^\n]*\n", b"", path.read_bytes(), count=1)
    kind, width, height, most, pixels = without_comment.split(maxsplit=4)
    check_equal((kind, most), (b"P5", b"255"), "kind of the image")
    width, height = int(width), int(height)
    check_equal(len(pixels), width * height, "pixels")
    rows = [pixels[row * width:(row + 1) * width] for row in reversed(range(height))]
    return width, height, [{0: 100, 254: 0, 205: -1}[pixel] for row in rows for pixel in row]


def mapping_run(context):
    """Folder of a short run whose robot maps first, and all topics of its MCAP file."""
    folder = context.simulate("paper_warehouse_slam", "--no-page", "--mcap", context.folder / "run.mcap",
                              "--set", "navigation.mapping.limit_s=5", "--set", "duration_s=2",
                              "--set", "localization.method=hyperbola")
    return folder, read_by_others(context, "decode", context.folder / "run.mcap")


# Message types of the layout that Foxglove's 3D panel shows, and the syntax of paths in plots.
SHOWN_IN_3D = {"nav_msgs/msg/OccupancyGrid", "sensor_msgs/msg/LaserScan",
               "visualization_msgs/msg/MarkerArray"}
MESSAGE_PATH = re.compile(r"(?P<topic>/[\w/]+)(?P<fields>(?:\.\w+(?:\[:\])?(?:\{\w+==\$\w+\})?)*)$")
FIELD = re.compile(r"\.(?P<name>\w+)(?P<list>\[:\])?(?:\{(?P<key>\w+)==\$(?P<variable>\w+)\})?")


def values_at(path, topics, variables):
    """Values at a Foxglove message path in all messages, for the syntax that the layout uses."""
    found = MESSAGE_PATH.match(path)
    if not check(found and found["topic"] in topics, f"{path!r} leads nowhere"):
        return []
    values = topics[found["topic"]]["messages"]
    for field in FIELD.finditer(found["fields"]):
        values = [value[field["name"]] for value in values]
        if field["list"]:
            values = [one for value in values for one in value]
        if field["key"]:
            wanted = variables[field["variable"]]
            values = [value for value in values if value[field["key"]] == wanted]
    return values


def leaves(tree):
    return [tree] if isinstance(tree, str) else [*leaves(tree["first"]), *leaves(tree["second"])]


@case
def the_layout_for_foxglove_shows_what_is_there(context):
    text = (context.source / "docs/foxglove_layout.json").read_text(encoding="utf-8")
    layout = json.loads(text)
    panels = layout["configById"]
    check_equal(sorted(leaves(layout["layout"])), sorted(panels), "panels that are laid out")
    _, topics = mapping_run(context)
    if topics is None:
        return
    frames = {frame["header"]["frame_id"] for topic in ("/tf", "/tf_static")
              for message in topics[topic]["messages"] for frame in message["transforms"]}
    kinds = []
    for name, panel in panels.items():
        kinds.append(name.split("!")[0])
        if kinds[-1] == "3D":
            check_in(panel["followTf"], sorted(frames), "frames")
            check_equal({topics.get(topic, {}).get("type") for topic in panel["topics"]}, SHOWN_IN_3D,
                        "types of the topics in 3D")
        elif kinds[-1] == "Plot":
            for path in panel["paths"]:
                values = values_at(path["value"], topics, layout["globalVariables"])
                check(len(values) > 5 and all(isinstance(value, (int, float)) for value in values),
                      f"{path['value']}: {values[:5]}")
        else:
            check_equal(kinds[-1], "RawMessages", "kind of panel")
            check(values_at(panel["topicPath"], topics, {}), f"{panel['topicPath']}: nothing")
    check_equal(sorted(kinds), ["3D", "Plot", "Plot", "RawMessages"], "panels")


@case
def a_robots_map_and_scans_are_in_the_file(context):
    folder, topics = mapping_run(context)
    if topics is None:
        return
    check_equal({topic: topics[topic]["type"] for topic in ("/map", "/p3at/scan")},
                {"/map": "nav_msgs/msg/OccupancyGrid", "/p3at/scan": "sensor_msgs/msg/LaserScan"}, "types")
    check_in("durability: 1", topics["/map"]["metadata"]["offered_qos_profiles"], "/map")
    if not check_equal(len(topics["/map"]["messages"]), 1, "maps"):
        return
    grid = topics["/map"]["messages"][0]
    width, height, cells = pgm_cells(folder / "map.pgm")
    check_equal((grid["info"]["width"], grid["info"]["height"]), (width, height), "cells of the map")
    # The file distinguishes three kinds of cells.
    kinds = [-1 if cell < 0 else 100 if cell >= 65 else 0 if cell < 20 else -1 for cell in grid["data"]]
    check(kinds == cells, "the cells are not those of map.pgm")
    check(cells.count(0) > 1000 and cells.count(100) > 100, "the map is empty")
    text = (folder / "map.yaml").read_text(encoding="utf-8")
    origin = grid["info"]["origin"]["position"]
    numbers = [float(word) for word in re.search(r"origin: \[(.*)\]", text)[1].split(",")]
    check_equal([origin["x"], origin["y"], 0.0], numbers, "origin")
    check_in("resolution: 0.05", text, "map.yaml")
    check(abs(grid["info"]["resolution"] - 0.05) < 1e-8, "resolution")

    scans = topics["/p3at/scan"]["messages"]
    check(len(scans) > 20, f"{len(scans)} scans")
    check_equal({scan["header"]["frame_id"] for scan in scans}, {"p3at/laser"}, "frame of scans")
    frames = [frame for message in topics["/tf"]["messages"] for frame in message["transforms"]]
    check({(scan["header"]["stamp"]["sec"], scan["header"]["stamp"]["nanosec"]) for scan in scans} ==
          {(frame["header"]["stamp"]["sec"], frame["header"]["stamp"]["nanosec"]) for frame in frames
           if (frame["header"]["frame_id"], frame["child_frame_id"]) == ("map", "p3at/base_link")},
          "a scan without its robot's frame")
    check_equal([(frame["header"]["frame_id"], frame["child_frame_id"])
                 for message in topics["/tf_static"]["messages"] for frame in message["transforms"]],
                [("p3at/base_link", "p3at/laser")], "frames at rest")


@case
def tags_are_located_from_the_file_as_from_the_tables(context):
    scenario = context.shipped("two_antennas")
    run_folder = context.simulate("two_antennas", "--no-page", "--mcap", context.folder / "run.mcap")
    context.run_well("localize", "run.mcap", "--scenario", scenario, "--method", "hyperbola", "--out", "o")
    context.run_well("localize", run_folder / "reads.csv", "--poses", run_folder / "antenna_poses.csv",
                     "--scenario", scenario, "--method", "hyperbola", "--out", "tables")
    check((context.folder / "o/reads.csv").read_bytes() == (run_folder / "reads.csv").read_bytes(),
          "reads.csv is not the run's")
    for name in ("truth/tags.csv", "truth/distances.csv"):
        check_equal(len(read_csv(context.folder / "o" / name)), len(read_csv(run_folder / name)), name)
    for row, other in zip(read_csv(context.folder / "o/estimates.csv"),
                          read_csv(context.folder / "tables/estimates.csv"), strict=True):
        check_equal((row["tag"], row["verdict"]), (other["tag"], other["verdict"]), "tag and verdict")
        for key in ("x_m", "y_m", "z_m"):
            check(abs(float(row[key]) - float(other[key])) < 1e-4, f"{row['tag']}: {key} differs")


@case
def tags_are_tracked_from_the_file_as_from_the_tables(context):
    scenario = context.shipped("conveyor")
    run_folder = context.simulate("conveyor", "--record-only", "--mcap", "run.mcap")
    options = ["--scenario", scenario, "--no-page"]
    context.run_well("track", run_folder, *options, "--out", "tables")
    context.run_well("track", "run.mcap", *options, "--out", "file")
    context.run_well("track", "run.mcap", *options, "--part-reads", 300, "--out", "parts")
    tables, file, parts = (context.folder / name for name in ("tables", "file", "parts"))
    check_equal((parts / "tracks.csv").read_bytes(), (file / "tracks.csv").read_bytes(), "tracks in parts")
    check_equal((file / "verdicts.csv").read_bytes(), (tables / "verdicts.csv").read_bytes(), "verdicts")
    # Phases in tables are rounded to six decimals.
    for row, other in zip(read_csv(file / "tracks.csv"), read_csv(tables / "tracks.csv"), strict=True):
        check_equal((row["tag"], row["stamp_s"]), (other["tag"], other["stamp_s"]), "tag and stamp")
        for key in ("x_m", "y_m"):
            check(abs(float(row[key]) - float(other[key])) < 1e-5, f"{row['tag']}: {key} differs")
    of_file, of_tables = (json.loads((folder / "tracks.json").read_text(encoding="utf-8"))
                          for folder in (file, tables))
    check(abs(of_file["along_m"]["mean"] - of_tables["along_m"]["mean"]) < 1e-6, "the truth is not judged by")
    for words, says in ((["--poses", "poses.csv"], "track: --poses is 'poses.csv', expected auto, true, tf or odom"),
                        (["--format", "form.yaml"], "track: --format can only be used with CSV")):
        result = context.run("track", "run.mcap", *words, "--out", "bad")
        check_equal(result.code, 2, f"exit code with {words}")
        check_in(says, result.err, "complaint")


@case
def the_page_shows_the_file_as_the_runs_folder(context):
    """The page shows the same, except for estimates, which a recording lacks."""
    scenario = context.shipped("two_antennas")
    folder = context.simulate("two_antennas", "--no-page", "--mcap", context.folder / "run.mcap")
    with served(context, folder, verb="view") as server:
        expected = server.get("/api/run")
    with served(context, "run.mcap", "--scenario", scenario, verb="view") as server:
        shown = server.get("/api/run")
    with served(context, "run.mcap", verb="view") as server:
        without = server.get("/api/run")
    check(len(expected["reads"]["t"]) > 500 and expected["estimates"], "the run has no reads or estimates")
    def reads_in(run):
        tags, antennas = ([entry[key] for entry in run[name]] for name, key in (("tags", "id"), ("antennas", "name")))
        reads = run["reads"]
        return sorted(zip(reads["t"], (tags[i] for i in reads["tag"]), (antennas[i] for i in reads["antenna"]),
                          reads["rssi"], reads["phase"]))

    for one, other in zip(reads_in(shown), reads_in(expected), strict=True):
        # Phases in tables have fewer digits than those in the file.
        if one[:4] != other[:4] or abs(one[4] - other[4]) > 0.0011:
            check(False, f"read {one} is {other} in the folder")
            break
    for key in ("tag_positions", "antennas", "robot_poses", "duration"):
        check_equal(shown[key], expected[key], key)
    check_equal([tag["position"] for tag in shown["tags"]], [tag["position"] for tag in expected["tags"]], "tags")
    check_equal(list(shown["antenna_poses"]), list(expected["antenna_poses"]), "moving antennas")
    check_equal(shown["scene"]["solids"], expected["scene"]["solids"], "the world")
    check_equal(shown["estimates"], [], "estimates")
    check_equal((without["scene"]["solids"], len(without["reads"]["t"])), ([], len(expected["reads"]["t"])),
                "without the scenario")
    result = context.run("view", folder, "--scenario", scenario)
    check_equal(result.code, 2, "a folder with a scenario")
    check_in("a run's folder has its world", result.err, "a folder with a scenario")


@case
def broken_files_are_reported(context):
    """Complete messages are used, with a warning; no crashes, and no partial results."""
    context.simulate("two_antennas", "--no-page", "--mcap", context.folder / "run.mcap")
    whole = (context.folder / "run.mcap").read_bytes()
    cut = context.write("cut.mcap", whole[:len(whole) * 2 // 3])
    result = context.run("localize", cut, "--out", "cut")
    check_equal(result.code, 0, "exit code with a file that is cut off")
    check_in("the file is cut off or broken here", result.err, "warnings")
    about_file = [line for line in result.err.splitlines() if "cut.mcap: byte " in line]
    check_equal(len(about_file), 1, f"warnings of the cut: {about_file}")
    check(len(read_csv(context.folder / "cut/reads.csv")) > 1000, "few reads")
    draw = random.Random(1)
    for _ in range(30):
        data = bytearray(whole)
        for _ in range(draw.choice((1, 10, 1000))):
            data[draw.randrange(len(data))] = draw.randrange(256)
        result = context.run("localize", context.write("odd.mcap", bytes(data)), "--out", "odd")
        check(result.code in (0, 2), f"exit code {result.code}: {result.err[-300:]}")
    for text, says in ((b"", "is not an MCAP file"), (whole[:8], "no reads"), (b"hello", "is not an MCAP file")):
        result = context.run("localize", context.write("bad.mcap", text), "--out", "bad")
        check_equal(result.code, 2, "exit code")
        check_in(says, result.err, "complaint")
        check_equal(len(result.err.splitlines()), 1, f"lines of {result.err!r}")
        check(not (context.folder / "bad/reads.csv").exists(), "reads.csv is there")
    # What is missing is in the part that is cut off: the error says so.
    result = context.run("localize", context.write("cut.mcap", whole[:2000]), "--out", "bad")
    check_equal((result.code, len(result.err.splitlines())), (2, 1), f"{result.err!r}")
    check_in("the file is cut off or broken here", result.err, "complaint")
    check_in("byte ", result.err, "complaint")


@case
def a_file_that_cannot_be_written(context):
    result = context.run("run", context.shipped("two_antennas"), "--no-page", "--out", "out", "--mcap",
                         "nowhere/run.mcap")
    check_equal(result.code, 2, "exit code")
    check_in("nowhere/run.mcap", result.err, "complaint")
    check(not (context.folder / "out/reads.csv").exists(), "reads.csv is there")


if __name__ == "__main__":
    main()
