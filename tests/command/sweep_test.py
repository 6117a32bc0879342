#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`tagfield sweep`: points of a suite, shards that can be killed, identical bytes for any shards; and
--resume of other long commands."""

import itertools
import json
import math
import os
import random
import shutil
import signal
import sqlite3
import statistics
import subprocess
import time

from common import (Skip, case, check, check_equal, check_in, check_near, clean_environment, main,
                    read_csv, read_json, run)
from faulty import fault_library

SCENARIO = """name: small
seed: 1
model: paper
robots: [{name: cart, start: [0, 0, 0], speed_m_s: 0.5, waypoints: [[2, 0.8], [3, 0]]}]
antennas: [{name: mobile, reader: r, on: cart, pose: [0, 0, 1], rate_hz: 10, model: paper}]
tags:
  - {id: a, position: [1, 2, 1]}
  - {id: b, position: [2, 2.5, 1]}
pose: {source: noisy, sigma_m: 0.01}
"""
GRID = """sweep:
  grid:
    pose.sigma_m: {from: 0.001, to: 0.1, steps: 3, scale: log}
    antennas.mobile.phase_noise_rad: [0.1, 0.5]
"""
RESULTS = ("points.csv", "runs.csv", "results.json", "results.sqlite", "sweep.html",
           "figures/mean_error.svg", "figures/located.svg")


def suite_of(context, more=GRID, seeds=3, methods="[hyperbola, {name: fine, method: ml}]", name="suite.yaml"):
    context.write("small.yaml", SCENARIO)
    return context.write(name, f"scenario: small.yaml\nseeds: {seeds}\nmethods: {methods}\n{more}")


def results_of(folder):
    return {name: (folder / name).read_bytes() for name in RESULTS if (folder / name).exists()}


def check_same(results, expected, what):
    check_equal(set(results), set(expected), f"files of {what}")
    for name, text in expected.items():
        check(results.get(name) == text, f"{name} of {what} differs")


def shards(context, suite, count, name, *, order=None):
    """Runs all shards in the given order and merges them; returns the folder."""
    folder = context.folder / name
    for shard in order or range(1, count + 1):
        context.run_well("sweep", suite, "--shard", f"{shard}/{count}", "--out", folder)
    context.run_well("sweep", "--merge", folder)
    return folder


def runs_in_logs(folder):
    """How often each run occurs in the logs."""
    counts = {}
    for log in sorted((folder / "shards").rglob("*.log")):
        for line in log.read_text(encoding="utf-8").splitlines()[1:]:
            key = line.split(" ")[1]
            counts[key] = counts.get(key, 0) + 1
    return counts


def line_of(result, what):
    """The only line of an error message."""
    lines = result.err.splitlines()
    check_equal((result.code, len(lines)), (2, 1), f"exit code and lines of {what}: {result.err!r}")
    return lines[0] if lines else ""


# --- Results --------------------------------------------------------------------------------------

@case
def the_same_bytes_whatever_the_shards(context):
    suite = suite_of(context)
    context.run_well("sweep", suite, "--out", "one", "--threads", "2")
    expected = results_of(context.folder / "one")
    check_equal(set(expected), set(RESULTS), "files")
    check_same(results_of(shards(context, suite, 3, "three", order=(3, 1, 2))), expected, "3 shards")
    check_same(results_of(shards(context, suite, 7, "seven", order=(4, 7, 1, 2, 6, 5, 3))), expected,
               "7 shards")
    check_equal(set(runs_in_logs(context.folder / "seven").values()), {1}, "times that each run was done")
    # A different number of shards continues from their results.
    mixed = context.folder / "mixed"
    context.run_well("sweep", suite, "--shard", "2/3", "--out", mixed)
    context.run_well("sweep", suite, "--out", mixed)
    check_same(results_of(mixed), expected, "one shard of three, then the rest")
    check_equal(set(runs_in_logs(mixed).values()), {1}, "times that each run was done in both")


@case
def numbers_are_those_of_a_bench(context):
    conditions = ("conditions:\n  - {name: as it is}\n  - {name: worse, set: {pose.sigma_m: 0.05}}\n"
                  "  - {name: lossy, lose: {share: 0.5}, seeds: 2, methods: [fine]}\n")
    suite = suite_of(context, conditions)
    context.run_well("bench", suite, "--out", "bench", "--no-page")
    context.run_well("sweep", suite, "--out", "sweep")
    benched = {(row["condition"], row["name"]): row
               for row in read_csv(context.folder / "bench/bench.csv")}
    rows = read_csv(context.folder / "sweep/points.csv")
    check_equal(len(rows), len(benched), "rows")
    for row in rows:
        of_bench = benched[row["condition"], row["name"]]
        for key in ("runs", "tags", "located", "ambiguous", "wrong", "mean_m", "median_m", "p95_m",
                    "max_m", "error_over_expected", "ratio_mean"):
            check_equal(row[key], of_bench[key], f"{key} of {row['condition']}, {row['name']}")


@case
def what_is_odd_in_a_condition_is_warned_of_once(context):
    conditions = "conditions:\n  - {name: exact, set: {pose.source: 'true', pose.wheel_noise: 0.1}}\n"
    result = context.run_well("sweep", suite_of(context, conditions), "--out", "out")
    odd = [line for line in result.err.splitlines() if "pose.wheel_noise has no effect with source: true" in line]
    check_equal(len(odd), 1, f"warnings: {result.err}")
    check_in("condition 'exact", odd[0], "what is odd")


@case
def a_grid_is_every_combination(context):
    context.run_well("sweep", suite_of(context), "--out", "out")
    rows = read_csv(context.folder / "out/points.csv")
    check_equal([(row["pose.sigma_m"], row["antennas.mobile.phase_noise_rad"], row["name"])
                 for row in rows],
                list(itertools.product(("0.001", "0.01", "0.1"), ("0.1", "0.5"),
                                       ("hyperbola", "fine"))), "rows")
    # A point equals a run with these settings.
    context.run_well("run", "small.yaml", "--seeds", "3", "--no-page", "--out", "run", "--set",
                     "pose.sigma_m=0.1", "--set", "antennas.mobile.phase_noise_rad=0.5", "--set",
                     "localization.method=hyperbola")
    errors = [tag["error_m"] for tag in read_json(context.folder / "run/summary.json")["tags"]
              if tag["error_m"] is not None]
    point = rows[-2]
    check_equal(int(point["located"]), len(errors), "located tags")
    if errors:
        check_near(float(point["mean_m"]), statistics.fmean(errors), 1e-12, "mean error")


@case
def a_latin_hypercube_has_one_point_in_each_stratum(context):
    design = ("sweep:\n  latin_hypercube:\n    points: 6\n    keys:\n"
              "      pose.sigma_m: {from: 0.001, to: 0.064, scale: log}\n"
              "      antennas.mobile.range_m: {from: 4, to: 10}\n"
              "      pose.source: [noisy, odometry]\n")
    context.run_well("sweep", suite_of(context, design, seeds=1, methods="[ml]"), "--out", "out",
                     "--no-page")
    rows = read_csv(context.folder / "out/points.csv")
    check_equal(sorted(int(math.log2(float(row["pose.sigma_m"]) / 0.001)) for row in rows),
                [0, 1, 2, 3, 4, 5], "strata of pose.sigma_m")
    check_equal(sorted(int(float(row["antennas.mobile.range_m"])) for row in rows),
                [4, 5, 6, 7, 8, 9], "strata of range_m")
    check_equal(sorted(row["pose.source"] for row in rows), ["noisy"] * 3 + ["odometry"] * 3, "words")


@case
def halving_gives_more_seeds_to_the_better(context):
    design = ("sweep:\n  list: [{pose.sigma_m: 0.2}, {pose.sigma_m: 0.001}, {pose.sigma_m: 0.1},\n"
              "         {pose.sigma_m: 0.4}, {pose.sigma_m: 0.003}]\n"
              "  adaptive: {target: mean_m, first_seeds: 2, keep_one_in: 2}\n")
    suite = suite_of(context, design, seeds=8, methods="[hyperbola]")
    context.run_well("sweep", suite, "--out", "one")
    expected = results_of(context.folder / "one")
    rows = read_csv(context.folder / "one/points.csv")
    # Rungs of 2, 4 and 8 seeds with 5, 3 and 2 points: the two smallest pose errors reach the last.
    check_equal(sorted(int(row["runs"]) for row in rows), [2, 2, 4, 8, 8], "runs")
    check_equal({row["pose.sigma_m"] for row in rows if row["runs"] == "8"}, {"0.001", "0.003"}, "winners")
    # With shards, one rung at a time.
    folder = context.folder / "three"
    for code in (3, 3, 0):
        for shard in (2, 3, 1):
            context.run_well("sweep", suite, "--shard", f"{shard}/3", "--out", folder)
        check_equal(context.run("sweep", "--merge", folder).code, code, "exit code of the merge")
    check_same(results_of(folder), expected, "3 shards")


@case
def the_database_answers(context):
    context.run_well("sweep", suite_of(context), "--out", "out", "--no-page")
    database = sqlite3.connect(context.folder / "out/results.sqlite")
    ask = lambda query: database.execute(query).fetchall()
    check_equal(ask("PRAGMA integrity_check"), [("ok",)], "integrity")
    check_equal(ask("SELECT (SELECT count(*) FROM points), (SELECT count(*) FROM results), "
                    "(SELECT count(*) FROM runs), (SELECT count(*) FROM tags)"),
                [(6, 12, 36, 72)], "rows of the tables")
    for point, name, located, mean in ask("SELECT point, name, located, mean_m FROM results"):
        errors = [error for (error,) in ask(f"SELECT error_m FROM tags WHERE point = {point} AND "
                                            f"name = '{name}' AND error_m IS NOT NULL")]
        check_equal(len(errors), located, "located")
        if errors:
            check_near(mean, statistics.fmean(errors), 1e-12, "mean_m")
    check_equal(len(ask('SELECT name FROM sweep WHERE "pose.sigma_m" < 0.02')), 8, "rows of the view")


@case
def the_page_shows_it(context):
    context.run_well("sweep", suite_of(context), "--out", "out")
    page = (context.folder / "out/sweep.html").read_text(encoding="utf-8")
    for word in ("Mean error", "Tags located", "phase_noise_rad 0.5", "fine", "<svg"):
        check_in(word, page, "sweep.html")
    for word in ("<script src", "http://", "https://"):
        check(word not in page, f"sweep.html holds {word}")


# --- Killed, resumed ------------------------------------------------------------------------------

def killed(context, arguments, after_s):
    """Runs the program and kills it after a time; returns whether it was still running."""
    process = subprocess.Popen([str(word) for word in (context.tagfield, *arguments)],
                               cwd=context.folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               env=clean_environment())
    try:
        process.wait(after_s)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
    return process.wait() == -signal.SIGKILL


@case
def killed_shards_go_on(context):
    suite = suite_of(context, seeds=10)
    begin = time.monotonic()
    context.run_well("sweep", suite, "--out", "whole", "--threads", "1")
    whole_s = time.monotonic() - begin
    chance = random.Random(1)
    folder = context.folder / "killed"
    kills = 0
    for _ in range(6):
        shard = chance.randint(1, 2)
        kills += killed(context, ("sweep", suite, "--shard", f"{shard}/2", "--out", folder, "--save-every",
                                  "0", "--threads", "1"), chance.uniform(0.0, 0.25 * whole_s))
    check(kills > 0, "no shard was killed")
    check_same(results_of(shards(context, suite, 2, "killed")), results_of(context.folder / "whole"),
               f"shards that were killed {kills} times")
    counts = runs_in_logs(folder)
    check_equal((len(counts), set(counts.values())), (60, {1}), "runs, and times that each was done")


def without_times(folder):
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name not in ("summary.json", "report.html")}


@case
def bench_and_runs_go_on(context):
    suite = suite_of(context, "conditions: [{name: a}, {name: b, set: {pose.sigma_m: 0.03}}]\n", seeds=10)
    for name, command in (("bench", ("bench", suite, "--no-timing", "--threads", "1")),
                          ("run", ("run", "small.yaml", "--seeds", "40", "--threads", "1"))):
        whole = context.folder / f"{name}_whole"
        begin = time.monotonic()
        context.run_well(*command, "--out", whole)
        whole_s = time.monotonic() - begin
        check(not (whole / "resume.log").exists(), f"{name}: resume.log is left")
        for share in (0.8, 0.6, 0.7, 0.5):
            folder = context.folder / f"{name}_cut_{share}"
            if killed(context, (*command, "--out", folder), share * whole_s) and (
                    (folder / "resume.log").exists()):
                break
        resumed = context.run_well(*command, "--out", folder, "--resume")
        check_equal(resumed.err, "", f"what {name} --resume says")
        check_equal(without_times(folder), without_times(whole), f"files of a resumed {name}")
    tags = [read_json(context.folder / folder / "summary.json")["tags"]
            for folder in ("run_whole", folder)]
    check(tags[0] == tags[1], "a resumed run has other tags")


@case
def resume_takes_what_was_kept(context):
    """A result in the log is not computed again, and a log of another suite is rejected."""
    suite = suite_of(context, "conditions: [{name: a}]\n", seeds=3, methods="[hyperbola]")
    context.run_well("sweep", suite, "--out", "swept", "--no-page")
    log = (context.folder / "swept/shards/of_1/1.log").read_text(encoding="utf-8").splitlines()
    result = context.run("bench", suite, "--out", "bench", "--resume")
    check_equal(result.code, 0, "--resume of nothing")
    # As a bench would store it, with a verdict that the run did not have.
    forged = log[1].replace('"located"', '"ambiguous"')
    check(forged != log[1], "nothing located")
    context.write("bench/resume.log", "\n".join((log[0], forged)) + "\n")
    refused = line_of(context.run("bench", suite, "--out", "bench", "--resume"), "another's log")
    check_in("of another suite or scenario", refused, "another's log")


# --- Bad input ------------------------------------------------------------------------------------

@case
def other_suites_are_refused(context):
    suite = suite_of(context)
    folder = context.folder / "out"
    context.run_well("sweep", suite, "--shard", "1/3", "--out", folder)
    log = folder / "shards/of_3/1.log"
    before = log.read_bytes()
    changes = {"the suite": lambda: suite_of(context, seeds=4),
               "the scenario": lambda: context.write("small.yaml", SCENARIO.replace("2.5", "2.6"))}
    for what, change in changes.items():
        suite_of(context)
        change()
        complaint = line_of(context.run("sweep", suite, "--shard", "2/3", "--out", folder), what)
        check_in("holds the sweep of another suite, or of one whose files were changed", complaint, what)
    suite_of(context)
    source = json.loads((folder / "sweep.json").read_text(encoding="utf-8"))
    build = json.loads(context.run_well("--version", "--json").out)
    program = (build["version"] + (f"+{build['commit']}" if build["commit"] else "") +
               (".changed" if build["changed"] else ""))
    check_equal(source["tagfield"], program, "the program that a sweep is of")
    if build["commit"]:  # Another build of the same version may get other results.
        context.write("out/sweep.json", json.dumps(source | {"tagfield": f"{build['version']}+000000000000"}))
        complaint = line_of(context.run("sweep", "--merge", folder), "another commit")
        check_in("+000000000000, and this is ", complaint, "another commit")
    context.write("out/sweep.json", json.dumps(source | {"tagfield": "0.0.9"}))
    for arguments in (("--merge", folder), (suite, "--shard", "2/3", "--out", folder)):
        complaint = line_of(context.run("sweep", *arguments), "another version")
        check_in("holds a sweep by tagfield 0.0.9, and this is ", complaint, "another version")
    context.write("out/sweep.json", json.dumps(source))
    # A shard's log copied from another sweep.
    context.write("out/shards/of_3/2.log", before.replace(source["work"].encode(), b"0" * 16, 1))
    complaint = line_of(context.run("sweep", "--merge", folder), "another's shard")
    check(complaint.startswith(f"tagfield: {folder}/shards/of_3/2.log:1: has results of another suite"),
          complaint)
    check(log.read_bytes() == before, "the shard's own log has changed")


@case
def a_shard_that_is_there_twice_is_refused(context):
    suite = suite_of(context, seeds=100)
    process = subprocess.Popen([context.tagfield, "sweep", suite, "--shard", "1/1", "--out", "out"],
                               cwd=context.folder, stdout=subprocess.DEVNULL)
    try:
        log = context.folder / "out/shards/of_1/1.log"
        while not log.exists() and process.poll() is None:
            time.sleep(0.01)
        time.sleep(0.1)
        second = context.run("sweep", suite, "--shard", "1/1", "--out", "out")
        if process.poll() is not None:
            raise Skip("the first was done before the second began")
    finally:
        process.kill()
        process.wait()
    check_in("is being written by another process", line_of(second, "the same shard twice"), "second")


@case
def results_that_differ_are_refused_and_copies_are_not(context):
    suite = suite_of(context, seeds=2, methods="[hyperbola]")
    folder = shards(context, suite, 2, "out")
    expected = results_of(folder)
    (folder / "shards/copy").mkdir()
    shutil.copy(folder / "shards/of_2/1.log", folder / "shards/copy/1.log")
    context.run_well("sweep", "--merge", folder)
    check_same(results_of(folder), expected, "a shard that is there twice")


@case
def damage_costs_the_runs_it_hits(context):
    suite = suite_of(context, seeds=2, methods="[hyperbola]")
    folder = shards(context, suite, 2, "out")
    expected = results_of(folder)
    log = folder / "shards/of_2/2.log"
    lines = log.read_bytes().splitlines(keepends=True)
    lines[2] = lines[2].replace(b"located", b"lo?ated", 1)
    log.write_bytes(b"".join(lines)[:-10])
    result = context.run("sweep", "--merge", folder)
    check_equal(result.code, 3, "exit code of a merge that lacks runs")
    check_in(f"tagfield: warning: {log}:3: is damaged", result.err, "warning")
    check_in("INCOMPLETE: 2 of 12 runs are missing", result.out, "merge")
    context.run_well("sweep", suite, "--shard", "2/2", "--out", folder)
    context.run_well("sweep", "--merge", folder)
    check_same(results_of(folder), expected, "a shard that was damaged and run again")


@case
def failures_are_listed_with_what_runs_them_again(context):
    context.write("world.sdf", "<sdf version='1.7'><world name='w'/></sdf>")
    away = context.write("away.sdf", "<sdf version='1.7'><world name='w'/></sdf>")
    suite = suite_of(context, "sweep: {grid: {world.path: [world.sdf, away.sdf]}}\n", seeds=2,
                     methods="[hyperbola]")
    context.write("small.yaml", SCENARIO + "world: {path: world.sdf}\n")
    whole = results_of(shards(context, suite, 1, "whole"))
    work = context.folder / "whole/sweep.json"
    check(work.exists(), "no sweep.json")
    # The file is valid when the sweep is checked, and broken when the run loads it, like a fault of a
    # machine. Points are prepared just before they run.
    text = away.read_text(encoding="utf-8")
    away.write_text(text.replace("</sdf>", ""), encoding="utf-8")
    result = context.run("sweep", suite, "--out", "out")
    check_equal(result.code, 3, "exit code where runs failed")
    check_in("2 runs failed", result.out, "list of failures")
    check_in(f"tagfield sweep {suite} --out out --again 1:2", result.out, "what runs one again")
    failures = read_json(context.folder / "out/results.json")["failures"]
    check_equal([(run["point"], run["seed"]) for run in failures], [(1, 1), (1, 2)], "failures")
    check_in("away.sdf", failures[0]["reason"], "reason")
    check_in("--again 1:1", (context.folder / "out/sweep.html").read_text(encoding="utf-8"), "page")
    again = context.run("sweep", suite, "--out", "out", "--again", "failed")
    check_equal(again.code, 3, "exit code where they fail again")
    check_equal(len(whole), len(RESULTS), "files")


@case
def a_full_disk_loses_nothing(context):
    library = fault_library(context.folder)
    suite = suite_of(context, seeds=2, methods="[hyperbola]")
    expected = results_of(shards(context, suite, 1, "whole"))
    for first in (1, 3, 6):
        folder = context.folder / f"full_{first}"
        full = run(["env", f"LD_PRELOAD={library}", f"FAULT=write:{first}+:ENOSPC", context.tagfield, "sweep", suite,
                    "--shard", "1/1", "--out", folder, "--save-every", "0", "--threads", "1"],
                   cwd=context.folder)
        check_in("No space left on device", line_of(full, f"a disk that is full at write {first}"), "line")
        context.run_well("sweep", suite, "--out", folder)
        check_same(results_of(folder), expected, f"a sweep whose disk was full at write {first}")
        check_equal(set(runs_in_logs(folder).values()), {1}, "times that each run was done")


BAD = (  # the suite's content, the line of the error, its message
    ("sweep: {grid: {pose.sigma_m: 1}}\n", 4, "must be a list of values, or a mapping {from, to, steps}"),
    ("sweep: {grid: {pose.sigm_m: [1]}}\n", 1, "did you mean 'sigma_m'?"),
    ("sweep: {grid: {pose.sigma_m: {from: 2, to: 1, steps: 3}}}\n", 4, "must be greater than 'from'"),
    ("sweep: {grid: {pose.sigma_m: {from: 0, to: 1, steps: 3, scale: log}}}\n", 4,
     "must be greater than 0 on a logarithmic scale"),
    ("sweep: {grid: {pose.sigma_m: [1, 1]}}\n", 4, "is 1 again, expected different values"),
    ("sweep: {grid: {a: [1]}, list: [{a: 1}]}\n", 4, "must have one of 'grid', 'list' and"),
    ("sweep: {gird: {a: [1]}}\n", 4, "did you mean 'grid'?"),
    ("sweep: {list: []}\n", 4, "must have at least one point"),
    ("sweep: {grid: {a: {from: 0, to: 1, steps: 2000}, b: {from: 0, to: 1, steps: 2000}}}\n", 4,
     "the sweep has over 1000000 points"),
    ("sweep: {grid: {a: [1]}, adaptive: {target: mean, method: fine, first_seeds: 1}}\n", 4,
     "did you mean 'mean_m'?"),
    ("sweep: {grid: {a: [1]}, adaptive: {target: mean_m, first_seeds: 1}}\n", 4, "has no 'method'"),
    ("sweep: {grid: {a: [1]}, adaptive: {target: mean_m, method: fine, first_seeds: 3}}\n", 4,
     "nothing is left to halve"),
)


@case
def bad_suites_get_one_line(context):
    for text, line, says in BAD:
        suite = suite_of(context, text)
        complaint = line_of(context.run("sweep", suite, "--out", "refused"), text)
        check(complaint.startswith(f"tagfield: {suite}:{line}: ") and says in complaint,
              f"said {complaint!r}, expected line {line} and {says!r}")
        check(not (context.folder / "refused").exists(), f"a folder is left behind by {text!r}")
    suite = suite_of(context)
    for arguments, says in (((suite, "--shard", "4/3"), "expected I/N with I from 1 to N"),
                            ((suite, "--shard", "x"), "expected I/N"),
                            ((suite, "--again", "9:9"), "there is no run '9:9'"),
                            ((), "expected SUITE, or --merge DIR, or --status DIR"),
                            (("--merge", "nowhere"), "nowhere: is not the folder of a sweep")):
        check_in(says, line_of(context.run("sweep", *arguments), arguments), "complaint")
    check_in("run it with tagfield sweep", line_of(context.run("bench", suite), "a sweep as a bench"), "bench")


# --- Many machines --------------------------------------------------------------------------------

def mpi_program(context):
    program = context.build / "bin/tagfield_sweep_mpi"
    if not program.exists() or not shutil.which("mpirun"):
        raise Skip("tagfield_sweep_mpi was not built (libopenmpi-dev), or there is no mpirun")
    return program


def mpirun(context, ranks, *arguments):
    # Open MPI's own allocations at exit are not leaks of Tagfield.
    ours = ["env", "ASAN_OPTIONS=detect_leaks=0:exitcode=99"] if "TAGFIELD_SANITIZED" in os.environ else []
    return run([*ours, "mpirun", "--allow-run-as-root", "--oversubscribe", "-np", ranks, mpi_program(context),
                *arguments], cwd=context.folder)


@case
def mpi_ranks_make_the_same_bytes(context):
    mpi_program(context)
    suite = suite_of(context)
    expected = results_of(shards(context, suite, 1, "one"))
    result = mpirun(context, 4, suite, "--out", "ranks")
    check_equal(result.code, 0, f"exit code of mpirun: {result.err!r}")
    folder = context.folder / "ranks"
    check_same(results_of(folder), expected, "4 ranks")
    counts = runs_in_logs(folder)
    check_equal((len(counts), set(counts.values())), (18, {1}), "runs, and times that each was done")
    # A folder that a shard has started.
    context.run_well("sweep", suite, "--shard", "1/2", "--out", "begun")
    check_equal(mpirun(context, 2, suite, "--out", "begun").code, 0, "exit code of mpirun")
    check_same(results_of(context.folder / "begun"), expected, "a shard and 2 ranks")
    check_equal(set(runs_in_logs(context.folder / "begun").values()), {1}, "times that each run was done")


@case
def scripts_submit_what_they_say(context):
    suite = suite_of(context, seeds=1, methods="[hyperbola]")
    expected = results_of(shards(context, suite, 1, "one"))
    scripts = context.source / "examples/09_cluster"
    environment = ["env", f"TAGFIELD={context.tagfield}"]
    if shutil.which("parallel"):
        done = run([*environment, scripts / "gnu_parallel.sh", suite, "parallel", "3"], cwd=context.folder)
        check_equal(done.code, 0, f"exit code of gnu_parallel.sh: {done.err!r}")
        check_same(results_of(context.folder / "parallel"), expected, "gnu_parallel.sh")
    # A fake sbatch that checks its options and runs the tasks one after another replaces Slurm.
    context.write("bin/sbatch", """#!/bin/bash
set -e
for word; do
  case "$word" in
    --array=1-*) tasks=${word#--array=1-} ;;
    --parsable | --job-name=* | --requeue | --output=* | --dependency=afterany:[0-9]* | --wrap) ;;
    -*) echo "unknown $word" >&2; exit 1 ;;
    *) command=$word ;;
  esac
done
for task in $(seq ${tasks:-1}); do SLURM_ARRAY_TASK_ID=$task bash -c "$command" >> log; done
echo 17
""").chmod(0o755)
    done = run([*environment, f"PATH={context.folder}/bin:{os.environ['PATH']}", scripts / "slurm.sh", suite,
                "slurm", "3"], cwd=context.folder)
    check_equal(done.code, 0, f"exit code of slurm.sh: {done.err!r}")
    check_same(results_of(context.folder / "slurm"), expected, "slurm.sh")


@case
def progress_is_reported_over_all_shards(context):
    suite = suite_of(context)
    context.run_well("sweep", suite, "--shard", "1/3", "--out", "out")
    status = context.run_well("sweep", "--status", "out").out
    check_in("suite: 6 of 18 runs (33.3 %), 0 failed, in 1 logs", status, "--status")
    check_in("to go", status, "--status")
    help_text = context.run_well("sweep", "--help").out
    for word in ("--shard", "--merge", "--status", "--again", "latin_hypercube", "docs/sweep.md"):
        check_in(word, help_text, "sweep --help")


if __name__ == "__main__":
    main()
