# SPDX-License-Identifier: Apache-2.0
"""rosbag2 recordings, as databases and folders, give the same results as the MCAP file of the same run.

The databases are written by this test, with Python's sqlite3 and the schema of rosbag2 (Jazzy).
"""

import os
import pathlib
import random
import sqlite3
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "command"))
from common import (  # noqa: E402  pylint: disable=wrong-import-position
    Skip, case, check, check_equal, check_in, main, read_csv, run)

TABLES = """
PRAGMA synchronous = OFF;
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
  serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL,
  type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
  encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
  data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema VALUES (4, 'jazzy');
"""
METADATA = """\
rosbag2_bagfile_information:
  version: 9
  storage_identifier: {storage}
  duration:
    nanoseconds: 1
  relative_file_paths:
{files}
  compression_format: ""
  compression_mode: ""
  custom_data: ~
  ros_distro: jazzy
"""


def recorded(context):
    """Folder of a run, and the types by topic and the messages of its MCAP file."""
    sample = context.build / "bin/mcap_sample"
    if not sample.exists():
        raise Skip("mcap_sample is not built (TAGFIELD_MCAP, liblz4-dev, libzstd-dev)")
    folder = context.simulate("two_antennas", "--no-page", "--mcap", context.folder / "run.mcap")
    lines = [line.split(" ") for line in run([sample, "read", context.folder / "run.mcap"],
                                             cwd=context.folder).out.splitlines() if line.startswith("/")]
    topics = {line[0]: line[1] for line in lines if not line[1].isdigit()}
    messages = [(line[0], int(line[2]), bytes.fromhex(line[4])) for line in lines if line[1].isdigit()]
    check(len(topics) == 9 and len(messages) > 1000, f"{len(topics)} topics, {len(messages)} messages")
    return folder, topics, messages


def write_database(path, topics, messages):
    path.parent.mkdir(exist_ok=True)
    with sqlite3.connect(path) as database:
        database.executescript(TABLES)
        ids = {name: i for i, name in enumerate(topics, 1)}
        database.executemany("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '', '')",
                             [(ids[name], name, kind) for name, kind in topics.items()])
        database.executemany("INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)",
                             [(ids[name], stamp, data) for name, stamp, data in messages])
    database.close()
    return path


def write_metadata(folder, names, storage="sqlite3"):
    (folder / "metadata.yaml").write_text(METADATA.format(
        storage=storage, files="\n".join(f"    - {name}" for name in names)), encoding="utf-8")


def located(context, recording, out, warnings=0):
    scenario = context.shipped("two_antennas")
    result = context.run_well("localize", recording, "--scenario", scenario, "--method", "hyperbola",
                              "--out", out)
    warning_lines = [line for line in result.err.splitlines() if "warning" in line]
    check_equal(len(warning_lines), warnings, f"warnings of {recording}: {warning_lines}")
    return context.folder / out


def check_same(one, other, what):
    for name in ("reads.csv", "estimates.csv", "antenna_poses.csv", "truth/tags.csv", "truth/distances.csv"):
        check((one / name).read_bytes() == (other / name).read_bytes(), f"{what}: {name} differs")


@case
def databases_and_folders_are_read_as_mcap_files(context):
    folder, topics, messages = recorded(context)
    from_mcap = located(context, "run.mcap", "from_mcap")
    check((from_mcap / "reads.csv").read_bytes() == (folder / "reads.csv").read_bytes(), "reads.csv")
    write_database(context.folder / "run.db3", topics, messages)
    check_same(located(context, "run.db3", "from_database"), from_mcap, "run.db3")
    # With any file name.
    os.rename(context.folder / "run.db3", context.folder / "recording")
    check_same(located(context, "recording", "from_recording"), from_mcap, "recording")
    # In two files, of which the second is first in alphabetical order.
    bag = context.folder / "bag"
    half = len(messages) // 2
    write_database(bag / "b_0.db3", topics, messages[:half])
    write_database(bag / "a_1.db3", topics, messages[half:])
    write_metadata(bag, ["b_0.db3", "a_1.db3"])
    check_same(located(context, "bag/", "from_folder"), from_mcap, "bag/")
    check_equal(sorted(path.name for path in bag.iterdir()), ["a_1.db3", "b_0.db3", "metadata.yaml"],
                "what is in the folder")
    # A folder with an MCAP file, too.
    (context.folder / "mcap_bag").mkdir()
    os.rename(context.folder / "run.mcap", context.folder / "mcap_bag/run_0.mcap")
    write_metadata(context.folder / "mcap_bag", ["run_0.mcap"], "mcap")
    check_same(located(context, "mcap_bag", "from_mcap_bag"), from_mcap, "mcap_bag")
    # As left by a killed recorder.
    (context.folder / "mcap_bag/metadata.yaml").unlink()
    check_same(located(context, "mcap_bag", "without", warnings=1), from_mcap, "without metadata.yaml")


@case
def names_of_results_are_those_of_recordings(context):
    _, topics, messages = recorded(context)
    (context.folder / "some").mkdir()
    write_database(context.folder / "some/my_bag/x.db3", topics, messages)
    write_metadata(context.folder / "some/my_bag", ["x.db3"])
    context.run_well("localize", "some/my_bag/", "--method", "hyperbola")
    check((context.folder / "runs/my_bag/reads.csv").exists(), "no folder runs/my_bag")


@case
def broken_ones_are_reported(context):
    _, topics, messages = recorded(context)
    path = write_database(context.folder / "run.db3", topics, messages)
    whole = path.read_bytes()
    cut = context.write("cut.db3", whole[:len(whole) * 3 // 4])
    result = context.run("localize", cut, "--out", "cut")
    check_equal(result.code, 0, f"exit code with a file that is cut off ({result.err[-300:]})")
    check_in("is cut off or broken after", result.err, "warnings")
    check(len(read_csv(context.folder / "cut/reads.csv")) > 1000, "few reads")
    draw = random.Random(1)
    for _ in range(30):
        data = bytearray(whole)
        for _ in range(draw.choice((1, 10, 1000))):
            data[draw.randrange(draw.choice((len(data), 10000)))] = draw.randrange(256)
        result = context.run("localize", context.write("odd.db3", bytes(data)), "--out", "odd")
        check(result.code in (0, 2), f"exit code {result.code}: {result.err[-300:]}")


@case
def refusals_are_one_line(context):
    _, topics, _ = recorded(context)
    bag = context.folder / "bag"
    bag.mkdir()

    def refused(path, says):
        result = context.run("localize", path, "--out", "refused")
        check_equal(result.code, 2, f"exit code of {path}")
        check_equal(len(result.err.splitlines()), 1, f"lines of complaint ({result.err})")
        check_in(says, result.err, "complaint")
        check(not (context.folder / "refused/reads.csv").exists(), "reads.csv is there")

    refused(context.write("text.db3", b"hello" * 3000), "is not a database of rosbag2")
    refused(context.folder / "gone.db3", "no such file")
    refused(write_database(context.folder / "empty.db3", {"/tf": "tf2_msgs/msg/TFMessage"}, []),
            "has no reads: no topic of type tagfield_msgs/msg/TagReads")
    refused(write_database(context.folder / "silent.db3", topics, []),
            "has no reads: there are no messages on /rfid/reads")
    json = context.write("json.db3", (context.folder / "silent.db3").read_bytes())
    with sqlite3.connect(json) as database:
        database.execute("UPDATE topics SET serialization_format = 'json'")
    refused(json, "has no reads: /rfid/reads is encoded as 'json', expected 'cdr'")
    for name, says in (("../empty.db3", "which is not in this folder"),
                       ("run.db3.zstd", "compressed as a whole")):
        write_metadata(bag, [name])
        refused(bag, says)


if __name__ == "__main__":
    main()
