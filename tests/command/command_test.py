#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The command end to end: help, check, progress, interruption, folders, SDF sensors."""

import json
import math
import os
import pty
import re
import select
import signal
import statistics
import subprocess
import time

from common import (SPEED_OF_LIGHT, Skip, case, check, check_between, check_equal, check_in,
                    check_near, clean_environment, files_in, main, position, read_csv, read_json)

SCENARIOS = ("paper_warehouse", "z_axis", "two_antennas", "moving_tags", "spawn")


# --- Help and check -------------------------------------------------------------------------------

@case
def help_says_what_there_is(context):
    said = {
        "": ["run", "localize", "report", "check", "bench", "new", "doctor", "--version", "scenarios/paper_warehouse.yaml"],
        "run": ["SCENARIO", "--seed ", "--seeds", "--out", "--set", "--threads", "--no-page",
                "pose.sigma_m=0.01", "reads.csv", "report.html"],
        "localize": ["READS", "--poses", "--method", "hyperbola", "joint", "auto", "--tag-height ",
                     "--tag-heights", "--vertical-side", "--reference", "--offset", "--pose-sigma",
                     "--out", "stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm",
                     "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw"],
        "report": ["DIR", "report.html"],
        "bench": ["SUITE", "--seeds", "--methods", "--conditions", "--no-timing", "--list-methods",
                  "bench.html", "bench.csv", "tags.csv", "docs/bench.md"],
        "check": ["FILE", "--json", "--set", "--model-path"]}
    for command, words in said.items():
        result = context.run_well(*command.split(), "--help")
        check_equal(result.err, "", f"stderr of {command} --help")
        for word in words:
            check_in(word, result.out, f"{command} --help")


@case
def help_lists_no_empty_conditions(context):
    for command in ("track", "localize", "coverage"):
        printed = context.run_well(command, "--help").out
        check(not re.search(r"(Excludes|Needs):\s*$", printed, re.MULTILINE), f"{command} --help: {printed}")
    check(not re.search(r"--tag TEXT \.\.\.", context.run_well("coverage", "--help").out), "coverage takes one --tag")


@case
def check_describes_our_world(context):
    world = context.source / "worlds/small_warehouse.sdf"
    result = context.run_well("check", world)
    check_equal(result.err, "", "warnings of our own world")
    check_in("world: small_warehouse", result.out, "check")
    described = json.loads(context.run_well("check", "--json", world).out)
    check_equal(described["warnings"], [], "warnings")
    check(len(described["models"]) >= 5, f"models are {described['models']}")
    check_equal(described["triangles"], sum(c["triangles"] for c in described["collisions"]), "triangles")
    check_in(f"models: {len(described['models'])}\n", result.out, "check")
    check_in(f"collisions: {len(described['collisions'])}, {described['triangles']} triangles", result.out,
             "check")
    check_equal((described["antennas"], described["tags"]), ([], []), "antennas and tags of the bare world")


@case
def check_describes_every_scenario(context):
    for name in SCENARIOS:
        path = context.shipped(name)
        result = context.run_well("check", path)
        check_equal(result.err, "", f"warnings of {name}")
        described = json.loads(context.run_well("check", "--json", path).out)
        check_equal(described["scenario"], name, "scenario")
        check_equal(described["world"], "small_warehouse", "world")
        for kind, key in (("antennas", "name"), ("tags", "id"), ("robots", "name")):
            check(described[kind], f"{name} has no {kind}")
            for body in described[kind]:
                check_in(body[key], result.out, f"check {name}")
    described = json.loads(context.run_well("check", "--json", context.shipped("paper_warehouse")).out)
    check_equal(len(described["tags"]), 10, "tags of paper_warehouse")
    check_equal(described["antennas"][0]["frequency_hz"], 865.7e6, "frequency_hz")
    check_equal(described["tags"][0], {"id": "tag1", "on": "world", "position_m": [4.58, -6.4, 1.25],
                                       "moves": False}, "tag1")
    changed = context.run_well("check", "--json", context.shipped("z_axis"), "--set",
                               "antennas.mobile.range_m=5")
    check_equal(json.loads(changed.out)["antennas"][0]["range_m"], 5, "range_m by --set")


@case
def check_describes_the_aws_warehouse(context):
    described = json.loads(context.run_well("check", "--json", context.aws_world()).out)
    # Each model of the world contains an included model.
    top = [model for model in described["models"] if "::" not in model]
    check_equal(len(top), 25, "models of the world itself")
    check_equal(len(described["collisions"]), 25, "collisions")
    for collision in described["collisions"]:
        check(collision["shape"] == "mesh" and collision["triangles"] > 0, f"{collision}")
    check(described["triangles"] > 0, "no triangles")
    check_equal(described["warnings"], [], "warnings")
    described = json.loads(context.run_well("check", "--json", context.shipped("aws_warehouse"), "--set",
                                            f"world.path={context.aws_world()}").out)
    check_equal((len(described["antennas"]), len(described["tags"])), (2, 10), "antennas, tags")


# --- A terminal, and signals ----------------------------------------------------------------------

class OnTerminal:
    """The program with its stderr on a pseudo-terminal."""

    def __init__(self, context, *arguments):
        try:
            self.terminal, theirs = pty.openpty()
        except OSError as error:
            raise Skip(f"there is no pseudo-terminal here ({error})") from error
        self.seen = ""
        # pylint: disable=consider-using-with
        self.process = subprocess.Popen(
            [str(context.tagfield), *map(str, arguments)], cwd=context.folder, stderr=theirs,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, env=clean_environment())
        os.close(theirs)

    def read(self, seconds):
        """Appends the output that arrives within so many seconds; returns False at the end."""
        ready, _, _ = select.select([self.terminal], [], [], seconds)
        if not ready:
            return True
        try:
            piece = os.read(self.terminal, 65536)
        except OSError:  # The other side of the terminal is closed.
            return False
        self.seen += piece.decode("utf-8", "replace")
        return bool(piece)

    def wait_for(self, pattern, seconds=60):
        """Waits for the pattern on the terminal; returns whether it appeared."""
        end = time.monotonic() + seconds
        while not re.search(pattern, self.seen) and time.monotonic() < end:
            if not self.read(0.1):
                break
        return re.search(pattern, self.seen) is not None

    def finish(self, seconds=60):
        """Waits for the end and returns the exit code and stdout."""
        end = time.monotonic() + seconds
        while time.monotonic() < end and self.read(0.1):
            pass
        try:
            out, _ = self.process.communicate(timeout=max(1.0, end - time.monotonic()))
        except subprocess.TimeoutExpired:
            self.process.kill()
            out, _ = self.process.communicate()
        os.close(self.terminal)
        return self.process.returncode, out


@case
def a_progress_bar_on_a_terminal_only(context):
    arguments = ("run", context.shipped("paper_warehouse"), "--out", "out")
    session = OnTerminal(context, *arguments)
    code, out = session.finish()
    check_equal(code, 0, "exit code")
    check_in("simulating [", session.seen, "the terminal")
    check_in("locating tags [", session.seen, "the terminal")
    simulated = session.seen.split("locating tags")[0]
    percents = [int(number) for number in re.findall(r"(\d+) %", simulated)]
    check(len(percents) > 20 and percents == sorted(percents) and percents[-1] == 100,
          f"percentages are {percents}")
    check(session.seen.endswith("\r\x1b[K"), f"the bar stays: {session.seen[-80:]!r}")
    check("\x1b" not in out and "simulating" not in out, "the bar goes to stdout")
    piped = context.run_well(*arguments)
    check_equal(piped.err, "", "stderr in a pipe")
    session = OnTerminal(context, *arguments, "--seeds", "20")
    check_equal(session.finish()[0], 0, "exit code")
    check_in("20 seeds [", session.seen, "the terminal")


@case
def long_work_says_what_it_does_in_a_log(context):
    context.write("slow.sh", "sleep 4\necho tag,x_m,y_m >$1/estimates.csv\n")
    suite = context.write("suite.yaml", f"scenario: {context.shipped('z_axis')}\nmethods: [hyperbola]\nseeds: 2\n"
                          "conditions:\n  - {name: one}\n")
    bench = ("bench", suite, "--no-page", "--threads", "1", "--out")
    slow = context.run_well(*bench, context.folder / "slow", "--command", f"slow=sh {context.folder}/slow.sh")
    check(len(slow.progress) >= 2, f"lines of progress: {slow.progress}")
    check_equal(slow.progress[0], "tagfield: bench: 0 %\n", "the first, before a run is done")
    check_in("tagfield: bench: 50 %, ", slow.progress[1], "the second, after half of them")
    quick = context.run_well(*bench, context.folder / "quick")
    check(quick.seconds > 3 or not quick.progress, f"short work says {quick.progress}")


def check_incomplete_folder(folder):
    files = files_in(folder)
    for name in ("reads.csv", "antenna_poses.csv", "estimates.csv", "report.html", "summary.json",
                 "truth/tags.csv", "truth/distances.csv"):
        check(name in files, f"the interrupted run left no {name}")
    check(not any("incomplete" in name or "partial" in name for name in files),
          f"half-written files: {sorted(files)}")
    check("INCOMPLETE" in files, "nothing says that the run is incomplete")
    summary = read_json(folder / "summary.json")
    check_equal(summary["complete"], False, "complete")
    reads = read_csv(folder / "reads.csv")
    check_equal(summary["reads"], len(reads), "reads")
    page = files["report.html"].decode("utf-8")
    check_in("Incomplete run", page, "the page")
    check(page.endswith("</html>\n"), "the page is cut off")
    return summary, reads


@case
def an_interrupted_run_keeps_what_it_had(context):
    for number in (signal.SIGINT, signal.SIGTERM):
        out = context.folder / f"out_{number}"
        session = OnTerminal(context, "run", context.shipped("paper_warehouse"), "--set",
                             "real_time=1", "--out", out)
        check(session.wait_for(r"\b[23] %"), f"no progress: {session.seen!r}")
        check(not (out / "reads.csv").exists(), "reads.csv is there before the end")
        session.process.send_signal(number)
        code, said = session.finish()
        check_equal(code, 130, f"exit code after {number.name}")
        check_in("INCOMPLETE", said, "stdout")
        summary, reads = check_incomplete_folder(out)
        check_between(summary["simulated_s"], 0.5, 60.0, "simulated_s")
        check(reads and max(float(row["stamp_s"]) for row in reads) <= summary["simulated_s"],
              "reads beyond the interruption")
        # The simulated part equals the beginning of a complete run.
        if number == signal.SIGINT:
            whole = files_in(context.simulate("paper_warehouse", name="whole"))["reads.csv"]
            check(whole.startswith((out / "reads.csv").read_bytes()),
                  "its reads are not the first of a whole run")


@case
def a_run_that_only_records_writes_the_same_tables(context):
    context.run_well("run", context.shipped("two_antennas"), "--out", "whole", "--no-page")
    result = context.run_well("run", context.shipped("two_antennas"), "--out", "tables",
                              "--record-only")
    check_in("folder: tables", result.out, "what is printed")
    tables = files_in(context.folder / "tables")
    check_equal(sorted(tables), ["antenna_poses.csv", "reads.csv", "truth/", "truth/antenna_poses.csv",
                                 "truth/distances.csv", "truth/robot_poses.csv", "truth/tags.csv"],
                "files")
    whole = files_in(context.folder / "whole")
    for name, content in tables.items():
        check(content == whole[name], f"{name} differs")
    for option in (["--seeds", "2"], ["--breakdown"]):
        result = context.run("run", context.shipped("two_antennas"), "--record-only", *option)
        check_equal(result.code, 2, f"exit code with {option}")


@case
def tags_without_errors_in_several_seeds_say_why(context):
    scenario = context.write("s.yaml", """
model: paper
robots:
  - {name: robot, start: [0, 0, 0], speed_m_s: 0.3, waypoints: [[3, 0], [3, 3]]}
  - {name: straight, start: [20, 0, 0], speed_m_s: 0.3, waypoints: [[26, 0]]}
antennas:
  - {name: a, on: robot, pose: [0, 0, 1], frequency_hz: 865.7e6, phase_noise_rad: 0.1, range_m: 4}
  - {name: b, on: straight, pose: [0, 0, 1], frequency_hz: 865.7e6, phase_noise_rad: 0.1, range_m: 4}
tags:
  - {id: known, position: [2, 1.5, 1.2]}
  - {id: mover, trajectory: [[0, 1, 1.5, 1], [20, 1.03, 1.5, 1]]}
  - {id: either_side, position: [23, 1.5, 1.2]}
  - {id: far, position: [90, 0, 1]}
localization: {method: hyperbola, reference_tags: [known]}
""")
    rows = context.run_well("run", scenario, "--seeds", "2", "--no-page").out.splitlines()
    said = {row.split()[0]: " ".join(row.split()[1:]) for row in rows if row}
    check_equal(said["known"], "a reference tag", "reference tag")
    check_equal(said["mover"], "located in 2 of 2 seeds, but it moved, so there is no error", "mover")
    check_equal(said["either_side"], "not located in any seed, ambiguous in 2 of 2", "either side")
    check_equal(said["far"], "not located in any seed", "far")
    check_in("2 located, 2 ambiguous, 2 not located (2 reference tags given)", "\n".join(rows), "counts")


@case
def an_interrupted_recording_is_whole_and_says_that_it_ends_early(context):
    out = context.folder / "out"
    session = OnTerminal(context, "run", context.shipped("paper_warehouse"), "--set",
                         "real_time=1", "--record-only", "--out", out)
    check(session.wait_for(r"\b[23] %"), f"no progress: {session.seen!r}")
    session.process.send_signal(signal.SIGINT)
    check_equal(session.finish()[0], 130, "exit code")
    check_in("complete up to then", (out / "INCOMPLETE").read_text(encoding="utf-8"), "INCOMPLETE")
    check(len(read_csv(out / "reads.csv")) > 20, "few reads")
    context.run_well("run", context.shipped("paper_warehouse"), "--record-only", "--out", out)
    check(not (out / "INCOMPLETE").exists(), "INCOMPLETE stays after a whole run")


@case
def a_killed_run_leaves_what_it_wrote_in_a_folder_that_says_so(context):
    out = context.folder / "out"
    session = OnTerminal(context, "run", context.shipped("paper_warehouse"), "--set",
                         "real_time=40", "--record-only", "--out", out)
    check(session.wait_for(r"\b9\d %"), f"no progress: {session.seen!r}")
    session.process.kill()
    session.process.wait()
    left = [path for path in out.iterdir() if path.name.startswith("incomplete-")]
    check_equal(len(left), 1, "folders left")
    text = (left[0] / "reads.csv").read_text(encoding="utf-8")
    check(text.endswith("\n"), "the last line is cut off")
    check(len(text) > 65536, "little was written")
    check(not (out / "reads.csv").exists(), "reads.csv is there")


@case
def many_interrupted_seeds_keep_the_finished_ones(context):
    session = OnTerminal(context, "run", context.shipped("z_axis"), "--seeds", "20000", "--out",
                         "out")
    check(session.wait_for(r"\b1 %"), f"no progress: {session.seen!r}")
    session.process.send_signal(signal.SIGINT)
    check_equal(session.finish()[0], 130, "exit code")
    summary, _ = check_incomplete_folder(context.folder / "out")
    check_between(len(summary["seeds"]), 100, 19999, "number of finished seeds")
    check_equal(len(summary["tags"]), len(summary["seeds"]), "tags of the finished seeds")


@case
def an_interrupted_bench_keeps_the_finished_runs(context):
    suite = context.write("suite.yaml", f"scenario: {context.shipped('z_axis')}\nseeds: 20000\n"
                                        "methods: [hyperbola]\nconditions: [{name: plain}]\n")
    session = OnTerminal(context, "bench", suite, "--out", "out")
    check(session.wait_for(r"\b1 %"), f"no progress: {session.seen!r}")
    check(not (context.folder / "out/bench.json").exists(), "bench.json is there before the end")
    session.process.send_signal(signal.SIGINT)
    code, said = session.finish()
    check_equal(code, 130, "exit code")
    check_in("INCOMPLETE", said, "stdout")
    summary = read_json(context.folder / "out/bench.json")
    check_equal(summary["complete"], False, "complete")
    entry = summary["entries"][0]
    check_between(entry["runs"], 100, 19999, "number of finished runs")
    check_equal(len(read_csv(context.folder / "out/tags.csv")), entry["tags"], "rows of tags.csv")
    check_in("Incomplete", (context.folder / "out/bench.html").read_text(encoding="utf-8"), "page")


@case
def at_a_multiple_of_real_time(context):
    free = context.simulate("z_axis", name="free")
    begin = time.monotonic()
    paced = context.simulate("z_axis", "--set", "real_time=50", name="paced")
    took = time.monotonic() - begin
    summary = read_json(paced / "summary.json")
    due = summary["simulated_s"] / 50.0
    # It must not run ahead; falling behind on a busy machine is no fault of the program.
    check(took >= due, f"took {took:.2f} s at 50 times real time, expected {due:.2f} s or more")
    check(summary["real_time_factor"] <= 50.5, f"ran at {summary['real_time_factor']}")
    for name in ("reads.csv", "antenna_poses.csv", "estimates.csv"):
        check_equal((paced / name).read_bytes(), (free / name).read_bytes(), f"{name} at a pace")


# --- Folders --------------------------------------------------------------------------------------

@case
def a_run_replaces_an_earlier_one_and_keeps_strangers(context):
    fresh = files_in(context.simulate("z_axis", name="fresh"))
    used = context.simulate("two_antennas", name="used")
    earlier = files_in(used)
    check(set(earlier) - set(fresh), "the earlier run has no file that the later one has not")
    context.write("used/notes.txt", "mine")
    context.write("used/photos/rack.jpg", b"\xff\xd8mine")
    context.simulate("z_axis", name="used")
    after = files_in(used)
    check_equal(after.pop("notes.txt", None), b"mine", "a stranger's file")
    check_equal(after.pop("photos/rack.jpg", None), b"\xff\xd8mine", "a stranger's file")
    after.pop("photos/", None)
    check_equal(set(after), set(fresh), "files")
    timed = ("summary.json", "report.html")  # They include wall times.
    for name, content in fresh.items():
        check(name in timed or after.get(name) == content, f"{name} is not the later run's")


@case
def without_a_page(context):
    out = context.simulate("z_axis", name="out")
    context.simulate("z_axis", "--no-page", name="out")
    files = files_in(out)
    check("reads.csv" in files and "summary.json" in files, "no data")
    check(not any(name.startswith(("report", "figures")) for name in files),
          f"an older page is left beside newer data: {sorted(files)}")


@case
def folders_with_odd_names(context):
    for name in ("with spaces", "Läufe/Größe ±1 日本語", "quote's \"and\" $HOME;x", "-dash"):
        out = context.folder / name
        result = context.run_well("run", context.shipped("z_axis"), f"--out={name}")
        check_in(f"page: {name}/report.html", result.out, "stdout")
        check("report.html" in files_in(out), f"no page in {name!r}")
        context.run_well("report", f"./{name}")
        context.run_well("localize", out / "reads.csv", "--poses", out / "antenna_poses.csv",
                         "--out", out / "Ünïcode localized")
        check("report.html" in files_in(out / "Ünïcode localized"), f"no page below {name!r}")


@case
def the_default_folder_is_named_after_the_scenario(context):
    context.run_well("run", context.shipped("z_axis"))
    check((context.folder / "runs/z_axis/report.html").exists(), "no runs/z_axis/report.html")
    context.run_well("run", context.shipped("z_axis"), "--set", "name=../a b/ü")
    names = sorted(path.name for path in (context.folder / "runs").iterdir())
    check(len(names) == 2 and not (context.folder / "a b").exists(), f"runs/ holds {names}")


@case
def names_of_tags_that_csv_html_and_svg_would_stumble_over(context):
    odd = ['a,b', 'say "hi"', "<script>alert(1)</script>", "&amp;", "E280 1160 ü 日", "x'y", "a::b"]
    tags = "".join(f"  - {{id: {json.dumps(name, ensure_ascii=False)}, position: "
                   f"[{1 + 0.3 * i}, 2, 1]}}\n" for i, name in enumerate(odd))
    path = context.write("odd.yaml", "robots:\n  - {name: r, start: [0, 0, 0], waypoints: [[3, 0], "
                         "[3, 1.5]]}\nantennas:\n  - {name: 'a,\"', on: r, pose: [0, 0, 1]}\ntags:\n"
                         + tags)
    folder = context.simulate(path)
    check_equal({row["tag"] for row in read_csv(folder / "reads.csv")}, set(odd), "tags read")
    check_equal({tag["id"] for tag in read_json(folder / "summary.json")["tags"]}, set(odd), "tags")
    page = (folder / "report.html").read_text(encoding="utf-8")
    check("<script>alert" not in page, "a tag's name became markup")
    check_in("&lt;script&gt;alert(1)&lt;/script&gt;", page, "the page")
    context.run_well("localize", folder / "reads.csv", "--poses", folder / "antenna_poses.csv",
                     "--tag-heights", folder / "tag_heights.csv", "--out", "again")
    check_equal({row["tag"]: row["x_m"] for row in read_csv(context.folder / "again/estimates.csv")
                 if row["verdict"] == "located"}.keys(),
                {row["tag"]: row["x_m"] for row in read_csv(folder / "estimates.csv")
                 if row["verdict"] == "located"}.keys(), "tags located again")


# --- SDF sensors in the form of the published plugin ----------------------------------------------

SENSOR_WORLD = """\
<?xml version="1.0"?>
<sdf version="1.6">
  <world name="published">
    <model name="portal">
      <static>true</static>
      <pose>1 2 0 0 0 1.5707963267948966</pose>
      <link name="link">
        <pose>0 0 1 0 0 0</pose>
        <sensor name="antenna" type="rfid">
          <pose>0.5 0 0.2 0 0 0</pose>
          <update_rate>15</update_rate>
          <plugin name="antenna" filename="libgazeboRfidAntennaPlugin.so">
            <frequency>865.7e6</frequency>
            <noisephi>NOISEPHI</noisephi>
            <noiserssi>NOISERSSI</noiserssi>
            <range>7</range>
            <communication_gain>3</communication_gain>
            <optional_distribution>none</optional_distribution>
          </plugin>
        </sensor>
      </link>
    </model>
    <model name="shelf">
      <static>true</static>
      <pose>3 2 0 0 0 0</pose>
      <link name="link">
        <sensor name="lower" type="rfidtag">
          <pose>0 0 0.5 0 0 0</pose>
          <plugin name="lower" filename="libgazeboRfidTagPlugin.so"/>
        </sensor>
        <sensor name="upper" type="rfidtag">
          <pose>0 0 1.5 0 0 0</pose>
          <plugin name="upper" filename="libgazeboRfidTagPlugin.so"/>
        </sensor>
      </link>
    </model>
    <model name="yard">
      <static>true</static>
      <link name="link">
        <sensor name="far" type="rfidtag">
          <pose>30 0 0 0 0 0</pose>
          <plugin name="far" filename="libgazeboRfidTagPlugin.so"/>
        </sensor>
      </link>
    </model>
  </world>
</sdf>
"""
# A rotation by 90° at (1, 2) moves (0.5, 0, 1.2) to (1, 2.5, 1.2).
SENSOR_ANTENNA = (1.0, 2.5, 1.2)
SENSOR_TAGS = {"shelf::lower": (3.0, 2.0, 0.5), "shelf::upper": (3.0, 2.0, 1.5)}
SENSOR_GAIN = 3.0
SENSOR_SECONDS = 20


def residuals_of_sensors(context, noise_phi, noise_rssi):
    """Residuals of phase and RSSI from the published model, in a scenario that only names the world."""
    context.write("published.world", SENSOR_WORLD.replace("NOISEPHI", str(noise_phi))
                  .replace("NOISERSSI", str(noise_rssi)))
    path = context.write("published.yaml", "world: {path: published.world}\n"
                         f"duration_s: {SENSOR_SECONDS}\n")
    folder = context.simulate(path)
    check_equal({row["antenna"]: position(row) for row in read_csv(folder / "antenna_poses.csv")},
                {"antenna": SENSOR_ANTENNA}, "the antenna's place")
    reads = read_csv(folder / "reads.csv")
    check_equal({row["tag"] for row in reads}, set(SENSOR_TAGS), "tags within 7 m")
    check_equal(len(reads), 2 * 15 * SENSOR_SECONDS, "reads at 15 Hz")
    phases, powers = [], []
    wavelength = SPEED_OF_LIGHT / 865.7e6
    for row in reads:
        distance = math.dist(SENSOR_ANTENNA, SENSOR_TAGS[row["tag"]])
        phases.append(math.remainder(float(row["phase_rad"]) - 4 * math.pi * distance / wavelength,
                                     2 * math.pi))
        amplitude = SENSOR_GAIN * wavelength / (4 * math.pi * distance)
        powers.append(float(row["rssi_dbm"]) - round(40 * math.log10(amplitude)))
    return phases, powers


@case
def sensors_noise_of_the_phase_is_noisephi(context):
    phases, powers = residuals_of_sensors(context, 0.4, 0.0)
    check_near(statistics.fmean(phases), 0.0, 5 * 0.4 / math.sqrt(len(phases)), "mean phase")
    check_near(statistics.stdev(phases), 0.4, 5 * 0.4 / math.sqrt(2 * len(phases)), "phase noise")
    check_equal(set(powers), {0.0}, "RSSI less eq. (5) without noise")


@case
def sensors_noise_of_the_rssi_is_noiserssi(context):
    phases, powers = residuals_of_sensors(context, 0.0, 0.01)
    check(max(map(abs, phases)) < 2e-6, f"phase is off by {max(map(abs, phases))} without noise")
    check(len(set(powers)) > 10, f"RSSI takes only {set(powers)}")


@case
def sensors_stand_beside_a_scenarios_own(context):
    context.write("published.world", SENSOR_WORLD.replace("NOISEPHI", "0.1")
                  .replace("NOISERSSI", "0.008"))
    path = context.write("robot.yaml", "world: {path: published.world}\nrobots:\n"
                         "  - {name: cart, start: [0, 0, 0], waypoints: [[4, 0], [4, 1]]}\n")
    folder = context.simulate(path)
    check(len(read_csv(folder / "truth/robot_poses.csv")) > 100, "the robot did not drive")
    check_equal({row["antenna"] for row in read_csv(folder / "reads.csv")}, {"antenna"}, "antennas")
    path = context.write("both.yaml", path.read_text(encoding="utf-8") +
                         "antennas: [{name: own, on: cart, pose: [0, 0, 1]}]\n"
                         "tags: [{id: mine, position: [2, 1.5, 1]}]\n")
    folder = context.simulate(path, name="both")
    check_equal({(row["antenna"], row["tag"]) for row in read_csv(folder / "reads.csv")},
                {(antenna, tag) for antenna in ("antenna", "own")
                 for tag in ("shelf::lower", "shelf::upper", "mine")}, "pairs that were read")
    located = {row["tag"]: position(row) for row in read_csv(folder / "estimates.csv")
               if row["verdict"] == "located"}
    for tag, place in {**SENSOR_TAGS, "mine": (2.0, 1.5, 1.0)}.items():
        check(tag in located and math.dist(located[tag], place) < 0.05,
              f"{tag} is located at {located.get(tag)}, expected {place}")


if __name__ == "__main__":
    main()
