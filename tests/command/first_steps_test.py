#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""First steps: --version, no arguments, typos, `new`, `doctor`, and `check` of all kinds of files."""

import json
import os
import re
import subprocess
import sys

from common import Skip, case, check, check_equal, check_in, main, read_json, run

SMALL = """name: small
seed: 1
model: paper
robots: [{name: cart, start: [0, 0, 0], speed_m_s: 0.5, waypoints: [[2, 0.8], [3, 0]]}]
antennas: [{name: mobile, reader: r, on: cart, pose: [0, 0, 1], rate_hz: 10, model: paper}]
tags: [{id: a, position: [1, 2, 1]}, {id: b, position: [2, 2.5, 1]}]
"""


@case
def version_says_what_was_built_of_what(context):
    text = context.run_well("--version").out
    number = re.search(r"project\(tagfield VERSION ([\d.]+)",
                       (context.source / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)
    check_equal(text.splitlines()[0], f"tagfield {number}", "the first line")
    version = json.loads(context.run_well("--version", "--json").out)
    check_equal(version["version"], number, "version")
    cache = (context.build / "CMakeCache.txt").read_text(encoding="utf-8")
    # Even if enabled, they are left out if their libraries are missing.
    for part, variable, made in (("ros1", "TAGFIELD_ROS1:BOOL", "lib/tagfield/rosbag.so"),
                                 ("ros2", "TAGFIELD_ROS2:BOOL", "adapters/ros2/libtagfield_ros2_topics.a")):
        asked_for = f"{variable}=ON" in cache
        check_equal(version["parts"][part], asked_for and (context.build / made).exists(), part)
    check_equal(version["parts"]["mqtt"], "libmosquitto_FOUND:INTERNAL=1" in cache, "mqtt")
    for part, present in version["parts"].items():
        section = text.split("without:")[0 if present else -1]
        check_in(f"  {part} ", section, "--version")
    head = run(["git", "-C", context.source, "rev-parse", "HEAD"])
    if head.code == 0 and version["commit"] is not None:
        check(re.fullmatch("[0-9a-f]{12,}", version["commit"]), f"commit is {version['commit']}")
        known = run(["git", "-C", context.source, "cat-file", "-t", version["commit"]])
        check_equal(known.out, "commit\n", f"what git says of {version['commit']}")
        check_in(version["commit"], text, "--version")


@case
def what_few_runs_use_is_not_loaded_at_each_start(context):
    linked = run(["ldd", context.tagfield]).out
    check_in("libc.so", linked, "what ldd says")
    for library in ("libCbc", "libddsc", "librosbag", "libarchive", "libmosquitto", "libcurl", "libpython", "libssl"):
        check(library not in linked, f"each start loads {library}")


@case
def the_command_alone_says_what_to_do_next(context):
    result = context.run_well()
    for words in ("tagfield run ", "tagfield new ", "tagfield localize ", "tagfield doctor", "--help"):
        check_in(words, result.out, "tagfield alone")
    check(len(result.out.splitlines()) < 20, "it is long")
    # The suggested scenario exists.
    scenario = re.search(r"tagfield run (\S+)", result.out).group(1)
    context.run_well("check", scenario)


@case
def slips_get_the_nearest(context):
    hall = context.shipped("z_axis")
    for arguments, said in (
            (["rnu", hall], "there is no command 'rnu' (did you mean 'run'?); see tagfield --help"),
            (["localise"], "there is no command 'localise' (did you mean 'localize'?); see tagfield --help"),
            (["xyzzyxyzzy"], "there is no command 'xyzzyxyzzy'; see tagfield --help"),
            (["--verson"], "there is no option '--verson' (did you mean '--version'?); see tagfield --help"),
            (["run", "--sede", "3", hall], "run: there is no option '--sede' (did you mean '--seed'?); see tagfield run --help"),
            (["run", hall, "--recordonly"], "run: there is no option '--recordonly' (did you mean '--record-only'?); see tagfield run --help"),
            (["run", hall, "--thread=3"], "run: there is no option '--thread' (did you mean '--threads'?); see tagfield run --help"),
            (["run", hall, "b.yaml"], "run: 'b.yaml' is one argument too many; see tagfield run --help"),
            (["run"], "run: SCENARIO is required; see tagfield run --help")):
        result = context.run(*arguments)
        check_equal((result.code, result.out, result.err), (2, "", f"tagfield: {said}\n"), f"{arguments}")


@case
def new_runs_as_it_is(context):
    result = context.run_well("new", "halls/my_hall")
    folder = context.folder / "halls/my_hall"
    check_equal(sorted(path.name for path in folder.iterdir()), ["analyse.py", "my_hall.sdf", "my_hall.yaml"], "files")
    for path in folder.iterdir():
        check("NAME" not in path.read_text(encoding="utf-8"), f"a placeholder is left in {path.name}")
    # The suggested next commands work.
    steps = re.findall(r"^  tagfield (\w+) (\S+)$", result.out, re.MULTILINE)
    check_equal([step[0] for step in steps], ["check", "run"], "steps")
    for command, scenario in steps:
        more = ["--out", "out"] if command == "run" else []
        check_equal(context.run_well(command, scenario, *more).err, "", f"warnings of {command}")
    summary = read_json(context.folder / "out/summary.json")
    check_equal((summary["located"], len(summary["tags"])), (4, 4), "tags that are located")
    again = context.run("new", "halls/my_hall")
    check_equal((again.code, again.err), (2, "tagfield: new: halls/my_hall exists already and is not changed\n"),
                "a second time")
    for name in ("a b", "-x", ".hidden", "ä", ""):
        check_equal(context.run("new", "--", name).code, 2, f"exit code of new {name!r}")
    check_equal(sorted(path.name for path in context.folder.iterdir()), ["halls", "out"], "what is left")


@case
def the_script_of_new_runs(context):
    package = context.build / "lib/python"
    if not list(package.glob("tagfield/_core*.so")):
        raise Skip("the Python package is not built")
    context.run_well("new", "hall")
    done = subprocess.run([sys.executable, context.folder / "hall/analyse.py", "2"], cwd=context.folder, check=False,
                          capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(package)})
    check_equal((done.returncode, done.stderr), (0, ""), "exit code and stderr of analyse.py")
    check_in("2 seeds:", done.stdout, "what it prints")
    for name in ("hall.png", "errors.png"):
        check((context.folder / "hall" / name).read_bytes().startswith(b"\x89PNG"), f"{name} is no PNG")


@case
def doctor_says_what_it_found(context):
    report = json.loads(context.run_well("doctor", "--json").out)
    found = {finding["key"]: finding for finding in report["findings"]}
    check(set(found) >= {"machine", "files", "ros2", "mpi", "python", "gazebo", "gz-sim", "browser", "roscore", "cbc"},
          f"keys are {sorted(found)}")
    check_in(f"{os.cpu_count()} threads", found["machine"]["what"], "machine")
    parts = json.loads(context.run_well("--version", "--json").out)["parts"]
    for key in ("ros1", "cbc", "mqtt", "mcap"):
        check_equal(found[key]["works"], parts[key], key)
    for key, finding in found.items():
        check(finding["what"], f"{key} says nothing")
        check_equal(bool(finding["how_to_get"]), not finding["works"], f"whether {key} says how to get it")
    # The same by another method.
    numpy = run(["python3", "-c", "import numpy; print(numpy.__version__)"])
    if numpy.code == 0:
        check_in(f"numpy {numpy.out.strip()}", found["python"]["what"], "python")
    # Another Python first on the PATH: what that of the system has is found nonetheless.
    other = context.write("bin/python3", f"#!/bin/sh\necho '{context.folder}/bin/python3 3.99.0'\n"
                          "for name in tagfield numpy pandas matplotlib; do echo $name missing; done\n")
    other.chmod(0o755)
    path = f"{context.folder}/bin:{os.environ['PATH']}"
    text = subprocess.run([context.tagfield, "doctor", "--json"], cwd=context.folder, check=True, capture_output=True,
                          text=True, env={**os.environ, "PATH": path}).stdout
    python = next(finding for finding in json.loads(text)["findings"] if finding["key"] == "python")
    check_in(f"{context.folder}/bin/python3 3.99.0", python["what"], "the first Python")
    check_in("/usr/bin/python3 3.", python["what"], "Python of the system")
    if not python["works"]:
        check_in("apt-get install python3-tagfield for /usr/bin/python3", python["how_to_get"], "what to do")
    # With an empty PATH.
    text = subprocess.run([context.tagfield, "doctor"], cwd=context.folder, check=True, capture_output=True, text=True,
                          env={"PATH": "/nonexistent", "CYCLONEDDS_URI": os.environ.get("CYCLONEDDS_URI", "")}).stdout
    works, rest = text.split("Not here, and how to get it")
    for key in set(found) - {"gazebo"}:
        absent = key in ("python", "gz-sim", "browser", "roscore", "mpi") or not found[key]["works"]
        check(re.search(rf"^  {key} ", rest if absent else works, re.MULTILINE), f"{key} stands elsewhere: {text}")


@case
def check_takes_every_kind_of_file(context):
    out = context.simulate("z_axis", "--no-page", "--mcap", context.folder / "run.mcap") \
        if json.loads(context.run_well("--version", "--json").out)["parts"]["mcap"] else context.simulate("z_axis", "--no-page")
    kinds = {
        out: "folder of a run", out / "reads.csv": "reads", out / "antenna_poses.csv": "antenna poses",
        out / "estimates.csv": "estimates", out / "truth/tags.csv": "table of the truth",
        out / "truth/distances.csv": "table of the truth",
        context.source / "worlds/small_warehouse.sdf": "world",
        context.write("heights.csv", "tag,height_m\na,1.2\n"): "heights of tags",
        context.write("places.csv", "tag,x_m,y_m,z_m\na,1,2,3\n"): "positions of tags",
        context.write("events.yaml", "events:\n  presence: {reads: 2, within_s: 1, gone_after_s: 3}\n"): "events",
        context.write("map.pgm", b"P5\n3 2\n255\n" + bytes([254, 0, 205] * 2)).with_name("map.yaml"): "map",
        context.write("calibration.yaml", "name: dock\nkind: calibration\nantennas: {}\n"): "calibration"}
    context.write("map.yaml", "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n"
                              "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
    for folder, kind in (("scenarios", "scenario"), ("scenarios/plan", "plan"), ("scenarios/sweep", "sweep"),
                         ("profiles/readers", "profile of a reader"), ("profiles/antennas", "profile of an antenna"),
                         ("profiles/tags", "profile of a tag"), ("profiles/datasets", "dataset format")):
        kinds[sorted((context.source / folder).glob("*.yaml"))[-1]] = kind
    kinds[context.source / "scenarios/bench/paper_warehouse.yaml"] = "suite"
    if (context.folder / "run.mcap").exists():
        kinds[context.folder / "run.mcap"] = "recording of ROS"
    for path, kind in kinds.items():
        described = json.loads(context.run_well("check", "--json", path).out)
        check_equal(described["kind"], kind, f"kind of {path}")
    text = context.run_well("check", out / "reads.csv").out
    check_in("kind: reads\n", text, "check reads.csv")
    check_in("tags: 1: ", text, "check reads.csv")


@case
def check_warns_of_maps_that_no_robot_can_use(context):
    context.write("map.yaml", "image: map.pgm\nresolution: 0.5\norigin: [0, 0, 0]\nnegate: 0\n"
                              "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
    for grey, lacking in ((254, "occupied"), (0, "free"), (205, "free")):
        context.write("map.pgm", b"P5\n3 2\n255\n" + bytes([grey] * 6))
        check_in(f"map.yaml: the map has no {lacking} cell", context.run_well("check", context.folder / "map.yaml").err, "check")


def results_of_all_commands(context):
    """A folder of each command, made quickly, and of each of its files what `check` is to call it."""
    out = context.folder
    small = context.write("small.yaml", SMALL)
    suite = context.write("suite.yaml", "scenario: small.yaml\nmethods: [hyperbola]\nconditions:\n  - {name: exact}\n")
    sweep = context.write("sweep.yaml", "scenario: small.yaml\nmethods: [hyperbola]\nseeds: 1\n"
                          "sweep: {grid: {pose.sigma_m: [0.01, 0.02]}}\n")
    run = context.simulate(small, name="run")
    for command, folder in (
            (("run", context.shipped("conveyor")), "conveyor"), (("localize", run), "localized"),
            (("track", context.shipped("conveyor")), "tracks"),
            (("coverage", small, "--height", "1", "--step", "1"), "coverage"),
            (("plan", context.shipped("plan/aisle"), "--no-links"), "plan"),
            (("bench", suite), "bench"), (("sweep", sweep), "sweep"), (("compare", run, run), "compared")):
        context.run_well(*command, "--out", out / folder)
    context.run_well("events", run, "--epcis", out / "epcis.json")
    context.run_well("events", run, "--epcis", out / "epcis.jsonl")
    context.write("events.jsonl", context.run_well("events", run, "--json").out)
    context.write("reads.jsonl", context.run_well("stream", small, "--speed", "0").out)
    return {"run": "folder of a run", "conveyor": "folder of a run", "localized": "folder of a run",
            "tracks": "folder of tracks", "coverage": "folder of a coverage", "plan": "folder of a plan",
            "bench": "folder of a bench", "sweep": "folder of a sweep", "compared": "folder of a comparison"}


KINDS_BY_NAME = {
    "reads.csv": "reads", "antenna_poses.csv": "antenna poses", "corrected_poses.csv": "antenna poses",
    "estimates.csv": "estimates", "tag_heights.csv": "heights of tags", "truth/tags.csv": "table of the truth",
    "truth/distances.csv": "table of the truth", "truth/robot_poses.csv": "table of the truth",
    "truth/antenna_poses.csv": "antenna poses", "summary.json": "summary of a run", "scene.json": "scene of a run",
    "top_view.json": "top view of the world", "tracks.csv": "tracks of tags", "order.csv": "order of tags",
    "verdicts.csv": "verdicts on tracks", "tracks.json": "results of tracking",
    "coverage_tags.csv": "coverage of tags", "coverage_1.00m.csv": "coverage at a height", "coverage.json": "coverage",
    "plan.json": "plan of antennas", "plan_antennas.csv": "antennas of a plan", "plan_layouts.csv": "layouts of a plan",
    "plan_positions.csv": "tag positions of a plan", "layout.yaml": "scenario", "bench.json": "results of a bench",
    "bench.csv": "results of a bench", "tags.csv": "tags of a bench", "points.csv": "points of a sweep",
    "runs.csv": "runs of a sweep", "results.json": "results of a sweep", "results.sqlite": "database of a sweep",
    "sweep.json": "suite of a sweep's folder", "compare.csv": "comparison of two runs",
    "compare.json": "comparison of two runs"}


@case
def check_knows_what_each_command_writes(context):
    kinds = results_of_all_commands(context)
    checked = set()
    for folder, kind in kinds.items():
        described = json.loads(context.run_well("check", context.folder / folder, "--json").out)
        check_equal(described["kind"], kind, folder)
        for path in sorted((context.folder / folder).rglob("*")):
            name = str(path.relative_to(context.folder / folder))
            if not path.is_file() or name == ".tagfield" or name.startswith("shards/"):
                continue
            kind = {".html": "page", ".svg": "figure"}.get(path.suffix) or KINDS_BY_NAME.get(name)
            if not check(kind, f"{folder}/{name}: of no kind in this test"):
                continue
            said = context.run_well("check", path, "--json").out
            check_equal(said and json.loads(said)["kind"], kind, f"{folder}/{name}")
            checked.add(name)
    check(set(KINDS_BY_NAME) <= checked | {"corrected_poses.csv"}, f"not written: {set(KINDS_BY_NAME) - checked}")
    for name, kind in (("epcis.json", "EPCIS document"), ("epcis.jsonl", "events of EPCIS, one per line"),
                       ("events.jsonl", "events, one per line"), ("reads.jsonl", "reads, one per line")):
        check_equal(json.loads(context.run_well("check", context.folder / name, "--json").out)["kind"], kind, name)


@case
def check_finds_what_is_damaged_in_results(context):
    order = "passed,rank,tag,stamp_s,sigma_s,before_next\nline,1,a,3.5,0.01,1\n"
    context.run_well("check", context.write("good.csv", order))
    for name, text, says in (
            ("order.csv", order + "line,2,b,inf,0.01,\n", "order.csv:3: stamp_s is 'inf'"),
            ("cut.csv", order + "line,2,b\n", "cut.csv:3: 3 fields"),
            ("cut.json", '{"suite": "a", "conditions": [', "is no valid JSON"),
            ("odd.json", '{"weather": "fine"}', "is JSON with the keys weather, which 'check' doesn't know"),
            ("infinite.json", '{"scene": 1e999, "antennas": []}', "is no valid JSON"),
            ("summary.json", '{"scenario": "a", "method": 3, "located": 1, "tags": []}', "summary.json"),
            ("cut.html", "<!DOCTYPE html>\n<html><body>", "does not end with </html>"),
            ("cut.jsonl", '{"eventType": "gone", "timestamp": "2020"}\n{"eventType"', "cut.jsonl:2: is no valid JSON"),
            ("text.sqlite", "point,rung\n", "text.sqlite: ")):
        result = context.run("check", context.write(name, text))
        check_equal((result.code, len(result.err.splitlines())), (2, 1), name)
        check_in(says, result.err, name)
    # A folder is as good as the files in it.
    folder = context.folder / "compared"
    run = context.simulate(context.write("small.yaml", SMALL), "--no-page")
    context.run_well("compare", run, run, "--out", folder)
    (folder / "compare.csv").write_text("tag,first_reads,second_reads\na,many,2\n", encoding="utf-8")
    result = context.run("check", folder)
    check_equal(result.code, 2, "exit code for a folder with a damaged table")
    check_in("compare.csv:2: first_reads is 'many'", result.err, "a folder with a damaged table")


@case
def check_prints_numbers_with_their_units(context):
    text = context.run_well("check", context.source / "profiles/readers/speedway_r420.yaml").out
    check(re.search(r"^transmit power: [\d.]+ dBm$", text, re.MULTILINE), text)
    poses = "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n0.1,a,0,0,1,0,0,0,1\n15.6,a,1,0,1,0,0,0,1\n"
    check_in("duration: 15.5 s\n", context.run_well("check", context.write("poses.csv", poses)).out, "duration")


@case
def check_names_the_model_in_force(context):
    check_in("model: multipath\n", context.run_well("check", context.shipped("warehouse_physics")).out, "physics")
    check_in("model: paper\n", context.run_well("check", context.shipped("paper_warehouse")).out, "paper")


@case
def check_says_what_is_none(context):
    for path, words in ((context.write("a.txt", "x"), "expected a scenario, plan, suite"),
                        (context.write("a.csv", "foo,bar\n1,2\n"), "is a table with the columns foo, bar"),
                        (context.folder, "is a folder, but not of a run"),
                        (context.write("bad_reads.csv", "stamp_s,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n1,a,t,x,1,1\n"),
                         "bad_reads.csv:2")):
        result = context.run("check", path)
        check_equal(result.code, 2, f"exit code for {path}")
        check_in(words, result.err, f"check {path}")
        check_equal(len(result.err.splitlines()), 1, f"lines for {path}")
    result = context.run("check", context.source / "profiles/tags/monza_4.yaml", "--set", "seed=1")
    check_in("--set changes a scenario", result.err, "check of a profile with --set")


if __name__ == "__main__":
    main()
