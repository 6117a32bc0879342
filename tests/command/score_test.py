#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""External estimators: `tagfield score`, and commands as methods of a bench."""

import json
import sys

from common import case, check, check_equal, check_in, check_near, main, read_csv, read_json, run

SCENARIO = "paper_warehouse"
# An external estimator: the position of each tag is that of the antenna at the strongest read.
PROGRAM = """\
import bisect, csv, pathlib, sys
folder = pathlib.Path(sys.argv[-1])
poses = sorted((float(p["stamp_s"]), p) for p in csv.DictReader(open(folder / "antenna_poses.csv")))
best = {}
for read in csv.DictReader(open(folder / "reads.csv")):
    if read["tag"] not in best or float(read["rssi_dbm"]) > float(best[read["tag"]]["rssi_dbm"]):
        best[read["tag"]] = read
with open(folder / "estimates.csv", "w") as out:
    print("tag,x_m,y_m", file=out)
    for tag, read in best.items():
        pose = poses[min(bisect.bisect([p[0] for p in poses], float(read["stamp_s"]) - 1e-6), len(poses) - 1)][1]
        print(tag, pose["x_m"], pose["y_m"], sep=",", file=out)
"""


def suite(context, methods, name="suite.yaml"):
    return context.write(name, f"scenario: {context.shipped(SCENARIO)}\nmethods: {methods}\n"
                               "conditions:\n  - {name: true pose}\n")


def program(context):
    return f"{sys.executable} {context.write('mine.py', PROGRAM)}"


# --- score ----------------------------------------------------------------------------------------

@case
def judges_as_run_does(context):
    folder = context.simulate(SCENARIO, "--no-page")
    result = context.run_well("score", folder / "estimates.csv", "--run", folder, "--json")
    ours, theirs = read_json(folder / "summary.json"), json.loads(result.out)
    check_equal(len(theirs["tags"]), 10, "tags")
    for one, other in zip(ours["tags"], theirs["tags"]):
        for key in ("id", "verdict", "truth_m", "reads", "reads_used"):
            check_equal(other[key], one[key], f"{one['id']}: {key}")
        check_near(other["error_m"], one["error_m"], 2e-6, f"{one['id']}: error_m")
    check_near(theirs["error_m"]["mean"], ours["error_m"]["mean"], 2e-6, "mean error")
    check_in("err [mm]", context.run_well("score", folder / "estimates.csv", "--run", folder).out, "table")


@case
def takes_the_least_that_a_table_can_say(context):
    folder = context.simulate(SCENARIO, "--record-only")
    truth = {row["tag"]: row for row in read_csv(folder / "truth/tags.csv")}
    x, y = float(truth["tag1"]["x_m"]), float(truth["tag1"]["y_m"])
    table = context.write("e.csv", f"tag,x_m,y_m\ntag1,{x + 0.3},{y - 0.4}\ntag2,0,0\ntag2,1,1\ntagg3,0,0\n")
    result = context.run_well("score", table, "--run", folder, "--json")
    tags = {tag["id"]: tag for tag in json.loads(result.out)["tags"]}
    check_near(tags["tag1"]["error_m"], 0.5, 1e-9, "error of tag1")  # a 3-4-5 triangle in the horizontal plane
    check_equal(tags["tag2"]["verdict"], "ambiguous", "two rows")
    check_equal(tags["tag3"]["verdict"], "not_located", "no row")
    check_in("errors are horizontal", result.err, "warnings")
    check_in("the run has no tag 'tagg3' (did you mean 'tag3'?)", result.err, "warnings")
    text = context.run_well("score", table, "--run", folder).out
    columns = next(line.split() for line in text.splitlines() if line.startswith("tag1 "))
    check_equal(columns[4:7], ["500.0", "-", "-"], "error, and the errors that the table does not state")


@case
def says_why_a_tag_has_no_position_or_no_error(context):
    folder = context.simulate(SCENARIO, "--record-only")
    def without(file, tag):
        rows = (folder / file).read_text().splitlines(keepends=True)
        (folder / file).write_text("".join(row for row in rows if tag not in row.split(",")))
    without("reads.csv", "tag4")      # It was never read,
    without("truth/tags.csv", "tag2")  # and of this one nobody knows where it was.
    table = context.write("e.csv", "tag,x_m,y_m\ntag1,0,0\ntag2,0,0\ntagg3,0,0\n")
    result = context.run_well("score", table, "--run", folder, "--json")
    summary = json.loads(result.out)
    tags = {tag["id"]: tag for tag in summary["tags"]}
    check_equal(sorted(tags), sorted(["tag1", "tag2", *(f"tag{i}" for i in range(3, 11))]), "tags")
    check_equal((tags["tag3"]["reason"], tags["tag4"]["reason"]), ("no row in e.csv", "cannot localize: never read"),
                "reasons")
    check(tags["tag3"]["reads"] > 0 and tags["tag4"]["reads"] == 0, "reads")
    check_equal((tags["tag2"]["verdict"], tags["tag2"]["error_m"]), ("located", None), "the tag of unknown position")
    check_in("the run has no tag 'tagg3' (did you mean 'tag3'?): it does not count", result.err, "stderr")
    text = context.run_well("score", table, "--run", folder).out
    check_in("2 located, 0 ambiguous, 8 not located; the true position of 1 located is unknown", text, "table")


@case
def a_verdict_overrides_the_number_of_rows(context):
    folder = context.simulate(SCENARIO, "--record-only")
    truth = {row["tag"]: row for row in read_csv(folder / "truth/tags.csv")}
    exact = f"{truth['tag1']['x_m']},{truth['tag1']['y_m']}"
    table = context.write("e.csv", f"tag,x_m,y_m,verdict\ntag1,{exact},located\ntag1,0,0,located\n"
                                   "tag2,0,0,not_located\ntag2,1,1,not_located\ntag3,0,0,ambiguous\n"
                                   "tag4,0,0,\ntag4,1,1,\ntag5,0,0,\ntag5,1,1,located\n")
    result = context.run_well("score", table, "--run", folder, "--json")
    tags = {tag["id"]: tag for tag in json.loads(result.out)["tags"]}
    check_equal([tags[f"tag{i}"]["verdict"] for i in range(1, 6)],
                ["located", "not_located", "ambiguous", "ambiguous", "located"], "verdicts")
    check_near(tags["tag1"]["error_m"], 0, 1e-9, "error of the first row")
    check_equal(len(tags["tag1"]["candidates_m"]), 1, "candidates of a located tag")
    check_equal(tags["tag5"]["estimate_m"][:2], [0, 0], "the first row")


@case
def says_what_is_wrong_in_a_line(context):
    folder = context.simulate(SCENARIO, "--record-only")
    for text, said in (("tag,x_m\na,1\n", "y_m"), ("tag,x_m,y_m\na,1,nan\n", ":2: "),
                       ("tag,x_m,y_m,verdict\na,1,2,sure\n", ":2: "),
                       ("tag,x_m,y_m,verdict\na,1,2,located\na,1,2,ambiguous\n", ":3: tag 'a' is ambiguous here, but"),
                       ("tag,x_m,y_m,expected_error_m\na,1,2,-1\n", "expected_error_m is below 0"),
                       ("tag,x_m,y_m,cov_xx,cov_xy,cov_yy\na,1,2,1,5,1\n", "not a covariance")):
        result = context.run("score", context.write("e.csv", text), "--run", folder)
        check_equal((result.code, len(result.err.splitlines())), (2, 1), f"{text!r}: {result.err!r}")
        check_in(said, result.err, repr(text))
    result = context.run("score", context.write("e.csv", "tag,x_m,y_m\n"), "--run", context.folder / "no")
    check_equal(result.code, 2, "no such run")


# --- commands as methods --------------------------------------------------------------------------

@case
def a_command_is_a_method(context):
    mine = program(context)
    out = context.folder / "bench"
    context.run_well("bench", suite(context, "[hyperbola]"), "--seeds", "2", "--no-page", "--out", out,
                     "--command", f"strongest={mine}")
    rows = {row["name"]: row for row in read_csv(out / "bench.csv")}
    check_equal(set(rows), {"hyperbola", "strongest"}, "methods")
    check_equal(rows["strongest"]["tags"], "20", "tags")
    # The same program after a run, evaluated by score, has the same errors.
    folder = context.simulate(SCENARIO, "--record-only", "--seed", "1")
    check_equal(run([*mine.split(), folder]).code, 0, "the program by itself")
    scores = json.loads(context.run_well("score", folder / "estimates.csv", "--run", folder, "--json").out)
    alone = {tag["id"]: tag["estimate_m"] for tag in scores["tags"]}
    for row in read_csv(out / "tags.csv"):
        if row["name"] == "strongest" and row["seed"] == "1" and row["verdict"] == "located":
            check_near(float(row["x_m"]), alone[row["tag"]][0], 1e-5, f"{row['tag']}: x")


def bench_of(context, name, table):
    """The bench's entry of a command that gives this table, and what was warned of."""
    (context.folder / name).mkdir()
    copied = context.write(f"{name}/estimates.csv", table)
    out = context.folder / f"bench_{name}"
    result = context.run_well("bench", suite(context, "[hyperbola]"), "--seeds", "1", "--methods", "mine", "--no-page",
                              "--out", out, "--command", f"mine=cp {copied}")
    return read_json(out / "bench.json")["entries"][0], result.err


@case
def a_stated_error_of_0_is_a_claim(context):
    rows = [f"tag{i},{i}.5,-9.5" for i in range(1, 11)]  # None of them is right.
    said = "method 'mine' states {} for 10 located tags"
    for name, columns, ends, claims, warned in (
            ("none", "tag,x_m,y_m", "", 0, None),
            ("exact", "tag,x_m,y_m,expected_error_m", ",0", 10, said.format("an expected error of 0")),
            ("zeros", "tag,x_m,y_m,cov_xx,cov_xy,cov_yy", ",0,0,0", 10, said.format("an expected error of 0")),
            ("both", "tag,x_m,y_m,expected_error_m,cov_xx,cov_xy,cov_yy", ",0,100,0,100", 0, None),
            ("flat", "tag,x_m,y_m,expected_error_m,cov_xx,cov_xy,cov_yy", ",0.001,0,0,0", 10,
             said.format("a covariance without an inverse"))):
        entry, err = bench_of(context, name, "\n".join([columns, *(row + ends for row in rows)]) + "\n")
        # With an expected error of 14 m, reads that don't fit are a reason to refuse a position.
        check(entry["located"] == 10 or (name == "both" and entry["located"] > 0), f"{name}: {entry['located']} located")
        check_equal(entry["false_claims"], claims, f"{name}: false claims")
        check_equal(entry["error_over_expected"] is None, name in ("none", "exact", "zeros"), f"{name}: no ratio")
        check_equal(entry["nees"] is None, name != "both", f"{name}: no NEES")
        if warned is None:
            check(" states " not in err, f"{name}: warned {err!r}")
        else:
            check_in(warned, err, f"{name}: stderr")


@case
def unknown_tags_of_a_command_are_warned_of(context):
    entry, err = bench_of(context, "typo", "tag,x_m,y_m\nTAG1,1,2\ntag2,1,2\n")
    check_equal((entry["located"], entry["not_located"]), (1, 9), "located, not located")
    check_in("method 'mine': estimates.csv: the reads have no tag 'TAG1'", err, "stderr")
    check("'tag2'" not in err, f"warned of a tag that is there: {err!r}")


@case
def suites_start_no_programs(context):
    mark = context.folder / "mark"
    path = suite(context, f'[hyperbola, {{name: mine, command: "touch {mark}; true"}}]')
    for arguments in ((), ("--methods", "mine"), ("--command", "other=true")):
        result = context.run("bench", path, *arguments)
        check_equal(result.code, 2, f"exit code with {arguments}")
        check_in("suite.yaml:2: method 'mine' is a command", result.err, "refusal")
        check_in("--allow-commands", result.err, "refusal")
        check(not mark.exists(), "the command was run")
    # Without that method, it does not matter.
    context.run_well("bench", path, "--methods", "hyperbola", "--no-page", "--out", context.folder / "out")
    context.run("bench", path, "--allow-commands")
    check(mark.exists(), "the command was not run with --allow-commands")


@case
def failures_are_reported_in_one_line(context):
    path = suite(context, "[hyperbola]")
    for command, said in (("echo first; echo 'no licence'; exit 3 #", "ended with code 3: no licence"),
                          ("true", "wrote no estimates.csv"),
                          ("kill -9 $$ #", "was ended by signal 9"),
                          ("sh -c 'echo tag,x_m > $0/estimates.csv'", "estimates.csv")):
        result = context.run("bench", path, "--command", f"bad={command}", "--out", context.folder / "out")
        check_equal((result.code, len(result.err.splitlines())), (2, 1), f"{command}: {result.err!r}")
        check_in(said, result.err, command)
    for argument, said in (("bad", "expected NAME=COMMAND"), ("a b=true", "letters"), ("hyperbola=true", "name"),
                           ("sar=true", "already")):
        result = context.run("bench", path, "--command", argument)
        check_equal(result.code, 2, argument)
        check_in(said, result.err, argument)


if __name__ == "__main__":
    main()
