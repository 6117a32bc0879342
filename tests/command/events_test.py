#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Events and JSON of reads: `tagfield events`, `tagfield stream`, EPCs in scenarios.

    events_test.py --tagfield PROGRAM --source SOURCE_DIR --build BUILD_DIR

EPCIS is validated against GS1's JSON schema (epcis_schema.py), and EPCs are compared with those of
another encoder, epc-tds. npm installs both into the build folder.
"""

import json
import random
import shutil
import signal
import subprocess
import time

from common import SKIPPED, case, check, check_equal, check_in, check_near, main, read_csv, run
from epcis_schema import is_valid, packages

assert SKIPPED == 77
SPEC = """events:
  logical_readers:
    - name: belt
      antennas: [gate_1, gate_2]
      read_point: urn:epc:id:sgln:0614141.12345.1
      biz_location: urn:epc:id:sgln:0614141.12345.0
      biz_step: receiving
      gone_biz_step: departing
      disposition: in_progress
  presence: {reads: 3, within_s: 1, gone_after_s: 1}
  cycles:
    - {name: half, duration_s: 0.5, reports: [{set: current, name: all}, {set: deletions}]}
  epcis: {source: presence, time_zone: "-05:00"}
"""
READS = """stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm
0.1,gate,gate_1,3074257BF7194E4000001A85,866900000,1,-50
0.2,gate,gate_2,3074257BF7194E4000001A85,866900000,1,-45.5
0.3,gate,gate_1,3074257BF7194E4000001A85,866900000,1,-51
0.4,gate,gate_1,E2801160600002054CC2096F,866900000,1,-51
0.4,gate,gate_1,pallet 7,866900000,1,-51
2.5,gate,gate_1,pallet 7,866900000,1,-51
"""


def events_of(context, *arguments):
    return [json.loads(line)
            for line in context.run_well("events", *arguments, "--json").out.splitlines()]


@case
def reads_become_events(context):
    reads = context.write("reads.csv", READS)
    spec = context.write("spec.yaml", SPEC)
    events = events_of(context, reads, "--spec", spec)
    presence = [(e["timestamp"][17:23], e["eventType"], e["epc"]) for e in events
                if e["eventType"] != "cycle"]
    sgtin = "3074257BF7194E4000001A85"
    check_equal(presence, [("00.100", "glimpsed", sgtin), ("00.300", "observed", sgtin),
                           ("00.400", "glimpsed", "E2801160600002054CC2096F"),
                           ("00.400", "glimpsed", "pallet 7"), ("01.300", "gone", sgtin),
                           ("02.500", "glimpsed", "pallet 7")], "presence")
    gone = [e for e in events if e["eventType"] == "gone"][0]
    check_equal(gone["epcUri"], "urn:epc:id:sgtin:0614141.812345.6789", "epcUri")
    check_equal((gone["reads"], gone["peakRssiCdbm"], gone["logicalReader"]), (3, -4550, "belt"),
                "of the tag that is gone")
    cycles = [e for e in events if e["eventType"] == "cycle"]
    check_equal([(c["number"], [(r["name"], r["count"]) for r in c["reports"]]) for c in cycles],
                [(1, [("all", 3)]), (2, [("deletions", 3)])], "cycles")


@case
def the_table_says_who_came_and_went(context):
    result = context.run_well("events", context.write("reads.csv", READS), "--spec",
                              context.write("spec.yaml", SPEC.replace("gate_2]", "gate_2, gate_3]")))
    check_in("gone at 1.300 s", result.out, "the table")
    check_in("1 times observed, 1 times gone, 2 cycles reported", result.out, "the table")
    check_in("nothing was read by antenna 'gate_3' of logical reader 'belt'", result.err, "warnings")


@case
def tags_are_gone_by_the_end_of_a_run(context):
    path = context.write("early.yaml", """\
name: early
duration_s: 6
model: link_budget
antennas: [{name: gate_1, reader: gate, pose: [0, 0, 1]}]
tags: [{id: tag, position: [1, 0, 1], disappears_s: 2}]
""")
    spec = context.write("spec.yaml", SPEC)
    context.run_well("run", path, "--no-page", "--out", context.folder / "run")
    changes = [event["eventType"] for event in events_of(context, context.folder / "run", "--spec", spec)]
    check("gone" in changes, f"the tag is gone a second after its last read, 4 s before the end: {changes}")
    bare = events_of(context, context.folder / "run/reads.csv", "--spec", spec)
    check("gone" not in [event["eventType"] for event in bare], "a table ends with its last read")


@case
def readers_of_a_spec_are_the_scenarios(context):
    path = context.write("one.yaml", """\
name: one
duration_s: 0.2
model: link_budget
antennas: [{name: gate_1, reader: gate, pose: [0, 0, 1]}]
tags: [{id: tag, position: [1, 0, 1]}]
""")
    spec = context.write("spec.yaml", SPEC)
    result = context.run("stream", path, "--speed", "0", "--mqtt", "mqtt://127.0.0.1:1", "--spec", spec)
    check_in("the scenario has no antenna 'gate_2', which logical reader 'belt' names", result.err, "stderr")


@case
def epcis_is_valid_by_the_public_schema(context):
    reads = context.write("reads.csv", READS)
    spec = context.write("spec.yaml", SPEC)
    for name in ("events.json", "events.jsonl"):
        file = context.folder / name
        context.run_well("events", reads, "--spec", spec, "--epcis", file)
        valid, why = is_valid(context, file)
        check(valid, f"{name} is not valid: {why[:500]}")
    document = json.loads((context.folder / "events.json").read_text())
    listed = document["epcisBody"]["eventList"]
    check_equal([(e["eventTime"], e["bizStep"]) for e in listed],
                [("2019-12-31T19:00:00.300000-05:00", "receiving"),
                 ("2019-12-31T19:00:01.300000-05:00", "departing")], "events")
    # The schema detects faults.
    for wrong, right in (("OBSERVE", "OBSERVED"), ("receiving", "receving"), ("-05:00\"", "EST\""),
                         ("\"type\":\"EPCISDocument\",", "")):
        text = json.dumps(document, separators=(",", ":")).replace(wrong, right)
        bad = context.write("bad.json", text)
        check(not is_valid(context, bad)[0], f"{right!r} for {wrong!r} is valid by the schema")


@case
def epcis_of_reports_and_of_any_run_is_valid(context):
    folder = context.simulate("conveyor", "--record-only")
    spec = context.write("spec.yaml", SPEC.replace("source: presence", "source: reports"))
    context.run_well("events", folder, "--spec", spec, "--epcis", "events.json")
    valid, why = is_valid(context, context.folder / "events.json")
    check(valid, f"not valid: {why[:500]}")
    document = json.loads((context.folder / "events.json").read_text())
    first = document["epcisBody"]["eventList"][0]
    cycle = [e for e in events_of(context, folder, "--spec", spec) if e["eventType"] == "cycle"][0]
    check_equal(len(first["epcList"]), cycle["reports"][0]["count"], "tags of the first report")


@case
def epcs_are_those_of_another_encoder(context):
    """Checks EPCs in the stream of a scenario, as users receive them."""
    draw = random.Random(1)
    digits = {"sgtin": 13, "sscc": 17, "sgln": 12, "grai": 12, "gdti": 12, "gsrn": 17}
    uris = []
    for i in range(300):
        scheme = list(digits)[i % len(digits)]
        length = draw.randint(6, 11)
        number = "".join(draw.choices("0123456789", k=digits[scheme]))
        fields = [str(draw.randint(0, 7)), number[:length], number[length:]]
        if scheme not in ("sscc", "gsrn"):
            fields.append(str(draw.randrange(2**38)))
        uris.append(f"urn:epc:tag:{scheme}-96:{'.'.join(fields)}")
    tags = "".join(f"  - {{id: '{uri}', position: [{1 + 0.001 * i:.3f}, 0, 1]}}\n"
                   for i, uri in enumerate(uris))
    scenario = context.write("epcs.yaml", "duration_s: 0.2\nantennas:\n"
                             f"  - {{name: a, pose: [0, 0, 1], range_m: 9}}\ntags:\n{tags}")
    lines = context.run_well("stream", scenario, "--speed", 0).out.splitlines()
    ours = {read["epc"]: read["epcHex"] for read in map(json.loads, lines)}
    check_equal(len(ours), len(uris), "tags that were read")
    folder = packages(context.source, context.build)
    theirs = subprocess.run(["node", context.source / "tests/epcis/others.mjs", folder, "epc"],
                            input="\n".join(uris), capture_output=True, text=True, check=True)
    for uri, bits in zip(uris, theirs.stdout.splitlines(), strict=True):
        check_equal(ours[uri], bits, uri)


@case
def a_stream_is_the_run_as_json(context):
    folder = context.simulate("conveyor", "--record-only")
    rows = read_csv(folder / "reads.csv")
    lines = context.run_well("stream", context.shipped("conveyor"), "--speed", 0, "--start",
                             "2024-02-29T12:00:00+01:00").out.splitlines()
    check_equal(len(lines), len(rows), "lines")
    for row, read in zip(rows[::50], map(json.loads, lines[::50])):
        check_equal((read["reader"], read["antennaName"], read["epc"]),
                    (row["reader"], row["antenna"], row["tag"]), "who")
        check_equal(read["antennaPort"], {"gate_1": 1, "gate_2": 2}.get(row["antenna"], 3), "port")
        check_near(read["peakRssiCdbm"], 100 * float(row["rssi_dbm"]), 0.51, "RSSI")
        check_near(read["phaseAngle"], 57.29577951308232 * float(row["phase_rad"]), 1e-4, "phase")
        check_equal(read["frequency"], float(row["frequency_hz"]) / 1000, "frequency")
        seconds = int(float(row["stamp_s"]))
        check_equal(read["timestamp"][:19], f"2024-02-29T11:00:{seconds:02}", "timestamp")
        check_equal(read["timestamp"][19:], row["stamp_s"][row["stamp_s"].index("."):] + "Z",
                    "its decimals")


def started(context, *arguments):
    return subprocess.Popen([context.tagfield, "stream", *arguments], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


@case
def a_stream_comes_line_by_line_and_ends_quietly(context):
    scenario = context.shipped("conveyor")
    program = started(context, scenario)
    first = json.loads(program.stdout.readline())  # 10 s before its end
    check_equal(first["timestamp"][:19], "2020-01-01T00:00:00", "the first read's time")
    check_equal(program.poll(), None, "its exit code while it runs")
    program.stdout.close()
    check_equal((program.wait(timeout=20), program.stderr.read()), (0, ""), "closed: how it ended")
    for number in (signal.SIGINT, signal.SIGTERM):
        program = started(context, scenario)
        lines = [program.stdout.readline()]
        program.send_signal(number)
        lines += program.stdout.readlines()
        check_equal((program.wait(timeout=20), program.stderr.read()), (130, ""), f"{number}")
        for line in lines:
            json.loads(line)


@case
def a_stream_keeps_its_pace(context):
    scenario = context.shipped("conveyor")
    begin = time.monotonic()
    context.run_well("stream", scenario, "--speed", 8)
    check(time.monotonic() - begin > 0.9 * 10.5 / 8, "8 times real time was faster than that")


@case
def bad_input_is_said_in_a_line(context):
    reads = context.write("reads.csv", READS)
    faults = (
        (("run", context.shipped("conveyor"), "--out", "-"), "'tagfield stream' writes reads"),
        (("track", reads, "--poses", reads, "--out", "-"), "reads.csv"),
        (("events", "nothing.csv"), "nothing.csv: no such file"),
        (("events", reads, "--start", "yesterday"), "events: --start: 'yesterday' must be a time"),
        (("events", reads, "--spec", reads), "reads.csv"),
        (("events", reads, "--spec", context.write("a.yaml", "events: {cycle: []}\n")),
         "a.yaml:1: unknown key 'cycle' in events (did you mean 'cycles'?)"),
        (("events", reads, "--epcis", "no/such/folder/e.json"), "no/such/folder"),
        (("stream", "nothing.yaml"), "nothing.yaml"),
        (("stream", context.shipped("conveyor"), "--speed", "-1"), "--speed"),
    )
    for words, part in faults:
        result = context.run(*words)
        check_equal(result.code, 2, f"exit code of {words}")
        check_in(part, result.err, f"complaint of {words}")
        check_equal(result.err.count("\n"), 1, f"lines of complaint of {words}")
    check(not (context.folder / "-").exists(), "there is a folder '-'")


if __name__ == "__main__":
    main()
