#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`tagfield bench`: suites, tables and the page; identical bytes for any number of threads."""

import math
import re
import statistics
import tarfile

from common import (Skip, case, check, check_equal, check_in, check_near, files_in, main,
                    percentile, read_csv, read_json, run)

NUMBERS = ("runs", "tags", "located", "ambiguous", "not_located", "wrong", "false_claims")


def suite_of(context, conditions, name="suite.yaml", methods="[hyperbola]", more=""):
    return context.write(name, f"scenario: {context.shipped('paper_warehouse')}\nseeds: 2\n{more}"
                               f"methods: {methods}\nconditions:\n{conditions}")


SMALL = """\
  - {name: true pose}
  - {name: lossy, lose: {share: 0.3, burst_s: 1, every_s: 10}}
  - name: pose 2 cm
    set: {pose.source: noisy, pose.sigma_m: 0.02}
    methods: [hyperbola]
"""
METHODS = "[hyperbola, {name: coarse, method: hyperbola, localization: {stride_m: 1}}]"


def bench(context, suite, *arguments, name="out"):
    """Runs a suite and returns its results folder."""
    folder = context.folder / name
    context.run_well("bench", suite, "--out", folder, *arguments)
    return folder


# --- Results --------------------------------------------------------------------------------------

@case
def writes_tables_and_a_page(context):
    folder = bench(context, suite_of(context, SMALL, methods=METHODS))
    summary = read_json(folder / "bench.json")
    check_equal((summary["suite"], summary["complete"]), ("suite", True), "suite, complete")
    check_equal([entry["condition"] + "/" + entry["name"] for entry in summary["entries"]],
                ["true pose/hyperbola", "true pose/coarse", "lossy/hyperbola", "lossy/coarse",
                 "pose 2 cm/hyperbola"], "entries")
    for entry in summary["entries"]:
        check_equal((entry["runs"], entry["tags"]), (2, 20), "runs and tags")
        check(entry["time_per_tag_ms"] > 0.0, "no time")
        check_equal(entry["located"] + entry["ambiguous"] + entry["not_located"], 20, "verdicts")
    rows = read_csv(folder / "bench.csv")
    for row, entry in zip(rows, summary["entries"]):
        for key in NUMBERS:
            check_equal(int(row[key]), entry[key], f"{key} in bench.csv")
        check_equal(float(row["mean_m"]), entry["error_m"]["mean"], "mean_m")
    page = (folder / "bench.html").read_text(encoding="utf-8")
    for word in ("true pose", "lossy", "pose 2 cm", "coarse", "Errors by condition", "<svg"):
        check_in(word, page, "bench.html")
    for word in ("<script src", "http://", "https://"):
        check(word not in page, f"bench.html holds {word}")
    check_in('<div class="table heat told"', page.split("<dl", 1)[0], "what the page opens with")
    check_equal(page.count("<details"), 3, "conditions that fold")


@case
def the_page_names_a_winner_of_each_condition(context):
    """The winner follows the rule stated on the page, recomputed from tags.csv."""
    folder = bench(context, suite_of(context, SMALL, methods="[ml, trilateration, hyperbola]"),
                   "--conditions", "true pose")
    right, means = {}, {}
    for name in ("ml", "trilateration", "hyperbola"):
        errors = [float(row["error_m"]) for row in read_csv(folder / "tags.csv")
                  if row["name"] == name and row["error_m"]]
        right[name], means[name] = sum(error <= 0.3 for error in errors), statistics.fmean(errors)
    competing = [name for name in right if right[name] >= 0.95 * max(right.values())]
    best = min(competing, key=means.get)
    check(len(competing) < 3, "all compete, so this shows little")
    page = (folder / "bench.html").read_text(encoding="utf-8")
    check_in(f'<td class="words">{best}<', page, "the heatmap")
    check_in(f"Winner: {best}, ", page, "the condition's title")
    check_equal(page.count('<td class="best"'), 1, "cells marked as the best")


@case
def statistics_are_those_of_the_tags(context):
    folder = bench(context, suite_of(context, SMALL, methods=METHODS))
    tags = read_csv(folder / "tags.csv")
    check_equal(len(tags), 5 * 2 * 10, "rows of tags.csv")
    for row in tags:
        if row["verdict"] != "located":
            check_equal(row["error_m"], "", "error of a tag that is not located")
            continue
        far = ((float(row["x_m"]) - float(row["truth_x_m"])) ** 2 +
               (float(row["y_m"]) - float(row["truth_y_m"])) ** 2) ** 0.5
        check_near(float(row["error_m"]), far, 1e-9, "error_m")
    for entry in read_json(folder / "bench.json")["entries"]:
        own = [float(row["error_m"]) for row in tags if row["error_m"] and
               (row["condition"], row["name"]) == (entry["condition"], entry["name"])]
        check_equal(len(own), entry["located"], "errors of the located")
        check_near(entry["error_m"]["mean"], statistics.fmean(own), 1e-9, "mean")
        check_near(entry["error_m"]["median"], statistics.median(own), 1e-9, "median")
        check_near(entry["error_m"]["p95"], percentile(own, 0.95), 1e-9, "p95")
        check_near(entry["error_m"]["max"], max(own), 1e-9, "max")


@case
def a_run_says_the_same(context):
    """A condition equals a run with the same overrides."""
    folder = bench(context, suite_of(context, SMALL), "--conditions", "pose 2 cm")
    out = context.simulate("paper_warehouse", "--seeds", "2", "--no-page", "--set",
                           "pose.source=noisy", "--set", "pose.sigma_m=0.02", name="run")
    of_run = {(str(tag["seed"]), tag["id"]): tag for tag in read_json(out / "summary.json")["tags"]}
    rows = read_csv(folder / "tags.csv")
    check_equal(len(rows), len(of_run), "tags")
    for row in rows:
        tag = of_run[row["seed"], row["tag"]]
        check_equal((row["verdict"], int(row["reads"])), (tag["verdict"], tag["reads"]), row["tag"])
        if tag["estimate_m"]:
            check_equal([float(row[key]) for key in ("x_m", "y_m", "z_m")], tag["estimate_m"],
                        f"estimate of {row['tag']}")


@case
def loses_reads(context):
    folder = bench(context, suite_of(context, SMALL), "--no-page")
    reads = {}
    for row in read_csv(folder / "tags.csv"):
        reads[row["condition"]] = reads.get(row["condition"], 0) + int(row["reads"])
    # 0.7 e^-0.1 of the reads are left; bursts in two runs of 80 s vary widely.
    check_near(reads["lossy"] / reads["true pose"], 0.633, 0.12, "share of reads left")


@case
def the_same_bytes_whatever_the_threads(context):
    suite = suite_of(context, SMALL, methods=METHODS)
    one = files_in(bench(context, suite, "--threads", "1", "--no-timing", name="one"))
    two = files_in(bench(context, suite, "--threads", "2", "--no-timing", name="two"))
    check_equal(set(one), set(two), "files")
    for name, text in one.items():
        check(text == two[name], f"{name} differs between 1 and 2 threads")
    for name in ("bench.json", "bench.csv"):
        check(b"time_per_tag_ms" not in one[name], f"{name} has times with --no-timing")


@case
def estimated_poses_are_aligned(context):
    folder = bench(context, suite_of(context, SMALL), "--no-page")
    entries = {entry["condition"]: entry for entry in read_json(folder / "bench.json")["entries"]}
    check_equal(entries["true pose"]["aligned_error_m"], None, "aligned error with the true pose")
    noisy = entries["pose 2 cm"]
    if noisy["aligned_error_m"]:
        squares = [[float(row[key]) ** 2 for row in read_csv(folder / "tags.csv")
                    if row["condition"] == "pose 2 cm" and row["aligned_error_m"]]
                   for key in ("aligned_error_m", "error_m")]
        check(sum(squares[0]) <= sum(squares[1]), "aligned errors are larger")


# --- Faults ---------------------------------------------------------------------------------------

BY_STRENGTH = "slow tags with random phases"
NO_PLACE = ("duplicate EPCs", "poses of another run", "slow tags", BY_STRENGTH)


@case
def false_claims_are_counted(context):
    folder = context.source / "scenarios/bench"
    text = (folder / "false_claims.yaml").read_text(encoding="utf-8")
    # By RSSI alone, a slow tag looks like a static one if its phases are random.
    text += f"  - {{name: {BY_STRENGTH}, scenario: slow_tags.yaml, fault: random_phases, methods: *moved}}\n"
    suite = context.write("false_claims.yaml", re.sub(r"(scenario: )(?=[\w.])", rf"\g<1>{folder}/", text))
    folder = bench(context, suite, "--seeds", "2", "--no-page", "--methods",
                   "hyperbola,trilateration", "--conditions",
                   "as it is,stamps 0.2 s late," + ",".join(NO_PLACE))
    counted = {}
    for row in read_csv(folder / "tags.csv"):
        key = row["condition"], row["name"]
        is_false = row["verdict"] == "located" and (
            row["condition"] in NO_PLACE or
            float(row["error_m"]) > 5 * float(row["expected_error_m"]))
        check_equal(row["false_claim"], str(int(is_false)), f"false_claim of {key} {row['tag']}")
        counted[key] = counted.get(key, 0) + is_false
    entries = {(entry["condition"], entry["name"]): entry
               for entry in read_json(folder / "bench.json")["entries"]}
    check_equal({key: entry["false_claims"] for key, entry in entries.items()}, counted, "counts")
    check_equal(entries["as it is", "hyperbola"]["located"], 40, "tags located without a fault")
    check_equal(entries["slow tags", "trilateration"]["false_claims"], 0, "slow tags that were claimed")
    check(entries[BY_STRENGTH, "trilateration"]["false_claims"] > 0, "no slow tag was claimed")
    conditions = {condition["name"]: condition for condition in read_json(folder / "bench.json")["conditions"]}
    check_equal(conditions["duplicate EPCs"]["faults"], ["duplicate_epcs"], "faults")
    check_equal(conditions["duplicate EPCs"]["no_bound"], "the reads are faulty", "bound of faulty reads")
    check_equal(conditions["slow tags"]["faults"], [], "faults of slow tags")


@case
def errors_are_compared_with_what_was_expected(context):
    folder = bench(context, suite_of(context, SMALL), "--conditions", "true pose")
    own = [float(row["error_m"]) / float(row["expected_error_m"])
           for row in read_csv(folder / "tags.csv") if row["error_m"]]
    ratio = math.sqrt(statistics.fmean(value * value for value in own))
    check_near(float(read_csv(folder / "bench.csv")[0]["error_over_expected"]), ratio, 1e-9, "ratio")
    check_near(ratio, 1.0, 0.4, "error over expected error of 20 tags")


# --- Recordings -----------------------------------------------------------------------------------

def twins(context):
    """A folder with recordings generated by benchmarks/twins.py, and their suite."""
    made = run(["/usr/bin/python3", "-B", context.source / "benchmarks/twins.py", "--write",
                context.folder / "twins", "--tags", "4", "--method", "ml", "--conditions",
                "circle one channel,rail one channel"], cwd=context.folder)
    check_equal((made.code, made.err), (0, ""), "twins.py")
    return context.folder / "twins"


@case
def recordings_are_judged_by_their_truth(context):
    folder = twins(context)
    out = bench(context, folder / "suite.yaml", "--seeds", "3", "--no-timing")
    summary = read_json(out / "bench.json")
    check_equal([(of["name"], of["recording"], of["scenario"], of["pose"], of["runs_planned"])
                 for of in summary["conditions"]],
                [(name, "reads.csv", None, "given", 1)
                 for name in ("circle one channel", "rail one channel")], "conditions")
    rows = read_csv(out / "tags.csv")
    check_equal(len(rows), 8, "tags, once each")
    for way, side in (("circle", ()), ("rail", ("--side=+y",))):
        files = folder / f"{way}_one_channel"
        context.run_well("localize", files / "reads.csv", "--poses", files / "poses.csv",
                         "--method", "ml", "--out", way, *side)
        by_hand = {row["tag"]: row for row in read_csv(context.folder / way / "estimates.csv")}
        truth = {row["tag"]: row for row in read_csv(files / "truth.csv")}
        for row in rows:
            if not row["condition"].startswith(way):
                continue
            alone = by_hand[row["tag"]]
            check_equal(row["verdict"], alone["verdict"], f"verdict on {way} {row['tag']}")
            for key in ("x_m", "y_m", "expected_error_m"):
                check_near(float(row[key]), float(alone[key]), 6e-7, f"{key} of {way} {row['tag']}")
            place = truth[row["tag"]]
            error = math.dist((float(row["x_m"]), float(row["y_m"])),
                              (float(place["x_m"]), float(place["y_m"])))
            check_near(float(row["error_m"]), error, 1e-9, "error")
            check(error < 0.05, f"{way} {row['tag']}: {error} m off")
    check_in("(1 run, pose: given)", (out / "bench.html").read_text(encoding="utf-8"), "page")


@case
def recordings_can_be_spoilt(context):
    folder = twins(context)
    suite = folder / "suite.yaml"
    text = suite.read_text(encoding="utf-8").replace(
        "  - name: rail", "    fault: random_phases\n  - name: rail")
    suite.write_text(text, encoding="utf-8")
    entries = read_json(bench(context, suite, "--no-page") / "bench.json")["entries"]
    check_equal([entry["located"] for entry in entries], [0, 4], "tags located, spoilt and not")


@case
def recordings_that_are_not_there_are_skipped(context):
    folder = twins(context)
    (folder / "rail_one_channel/truth.csv").unlink()
    result = context.run_well("bench", folder / "suite.yaml", "--out", "out")
    check_equal(result.err, f"tagfield: warning: {folder}/suite.yaml:7: condition 'rail one channel' "
                f"is skipped: there is no {folder}/rail_one_channel/truth.csv\n", "warning")
    summary = read_json(context.folder / "out/bench.json")
    check_equal([of["name"] for of in summary["conditions"]], ["circle one channel"], "conditions")
    check_equal((summary["complete"], len(summary["warnings"])), (True, 1), "complete, warnings")
    (folder / "circle_one_channel/reads.csv").unlink()
    context.run_well("bench", folder / "suite.yaml", "--out", "none")
    check_equal(read_csv(context.folder / "none/bench.csv"), [], "rows where nothing is there")


def require_archives(context):
    """Skips the case in builds without libarchive."""
    if "built without libarchive" in context.run("localize", "none.tar", "--format", "adarf").err:
        raise Skip("this tagfield was built without libarchive (libarchive-dev)")


@case
def archives_are_as_good_as_their_tables(context):
    require_archives(context)
    folder = twins(context)
    reads = folder / "circle_one_channel/reads.csv"
    plain = files_in(bench(context, folder / "suite.yaml", "--no-timing", name="plain"))
    with tarfile.open(folder / "circle_one_channel/reads.tar.gz", "w:gz") as archive:
        archive.add(reads, "published/1/reads.csv")
    reads.unlink()
    suite = folder / "suite.yaml"
    suite.write_text(suite.read_text(encoding="utf-8").replace(
        "circle_one_channel/reads.csv", "circle_one_channel/reads.tar.gz"), encoding="utf-8")
    packed = files_in(bench(context, suite, "--no-timing", name="packed"))
    check(plain["tags.csv"] == packed["tags.csv"], "tags.csv differs where reads are in an archive")


# --- The command ----------------------------------------------------------------------------------

@case
def filters_choose(context):
    suite = suite_of(context, SMALL, methods=METHODS)
    folder = bench(context, suite, "--methods", "coarse", "--seeds", "1", "--no-page")
    summary = read_json(folder / "bench.json")
    check_equal([entry["condition"] for entry in summary["entries"]], ["true pose", "lossy"],
                "conditions with coarse")
    check_equal({entry["runs"] for entry in summary["entries"]}, {1}, "runs with --seeds 1")
    check(not (folder / "bench.html").exists(), "bench.html is there with --no-page")
    folder = bench(context, suite, "--conditions", "lossy,true pose", "--seeds", "1", name="two")
    summary = read_json(folder / "bench.json")
    check_equal([condition["name"] for condition in summary["conditions"]], ["true pose", "lossy"],
                "conditions, in the suite's order")


@case
def methods_are_listed(context):
    result = context.run_well("bench", "--list-methods")
    check_in("hyperbola", result.out, "--list-methods")
    help_text = context.run_well("bench", "--help").out
    for word in ("SUITE", "--seeds", "--methods", "--conditions", "--no-timing", "conditions:",
                 "bench.html", "scenarios/bench/paper_warehouse.yaml"):
        check_in(word, help_text, "bench --help")


BAD = (  # the suite's conditions, the line of the error, its message
    ("  - {nam: a}\n", 5, "did you mean 'name'?"),
    ("  - {name: a, set: {pose.sigm_m: 1}}\n", 5, "did you mean 'sigma_m'?"),
    ("  - {name: a}\n  - {name: b, lose: {share: 2}}\n", 6, "must be from 0 to 1"),
    ("  - {name: a, believed: nothing}\n", 5, "known: unknown, exact"),
    ("  - {name: a, believed: {sigma_m: -1}}\n", 5, "must be 0 or more"),
    ("  - {name: a, scenario: no.yaml}\n", 5, "there is no such file"),
    ("  - {name: a, methods: [hyprbola]}\n", 5, "did you mean 'hyperbola'?"),
    ("  - {name: a, localization: {strid_m: 1}}\n", 5, "did you mean 'stride_m'?"),
    ("  - {name: a, localization: {neighbours: 3}}\n", 5, "it is a setting of auto, landmarc"),
    ("  - {name: a, set: {tags.tag77.position: [1, 2, 3]}}\n", 5, "has no element 'tag77'"),
    ("  - {name: a}\n  - {name: a}\n", 6, "is there twice"),
    ("  - {name: a, seeds: -1}\n", 5, "expected a whole number"),
    ("  - {name: a, set: [1, 2]}\n", 5, "must be a mapping"),
    ("  - {name: a, fault: random_phase}\n", 5, "did you mean 'random_phases'?"),
    ("  - {name: a, fault: {timestamp_delay_s: -1}}\n", 5, "must be greater than 0"),
    ("  - {name: a, fault: {swapped_antennas: [mobile, b]}}\n", 5, "there is no antenna 'b'"),
    ("  - name: a\n    recording: {reads: r, poses: p, truth: t}\n    seeds: 2\n", 7,
     "has no effect on a recording"),
    ("  - {name: a, recording: {reads: r, poses: p, truht: t}}\n", 5, "did you mean"),
    ("  - {name: a, recording: {reads: r, poses: p, truth: t, side: up}}\n", 5, "is 'up'"),
    ("  - {name: a, recording: {reads: suite.yaml, truth: suite.yaml, format: adraf}}\n", 5,
     "did you mean 'adarf'"),
)


def check_refused(context, suite, begins, says, *arguments):
    result = context.run("bench", suite, "--out", "refused", *arguments)
    check_equal(result.code, 2, f"exit code for {says!r}")
    check_equal(result.out, "", f"stdout for {says!r}")
    lines = result.err.splitlines()
    check(len(lines) == 1 and lines[0].startswith(f"tagfield: {begins}") and says in lines[0],
          f"said {result.err!r}, expected {begins!r} … {says!r}")
    check(not (context.folder / "refused").exists(), f"a folder is left behind by {says!r}")


@case
def bad_suites_are_refused(context):
    for conditions, line, says in BAD:
        suite = suite_of(context, conditions)
        check_refused(context, suite, f"{suite}:{line}: ", says)
    suite = suite_of(context, "  - {name: a}\n", methods="[hyperbole]")
    check_refused(context, suite, f"{suite}:3: ", "did you mean 'hyperbola'?")
    suite = suite_of(context, "  - {name: a}\n", more="seeds: 3\n")
    check_refused(context, suite, f"{suite}:3: ", "has 'seeds' twice")
    good = suite_of(context, SMALL)
    check_refused(context, good, "--methods: ",
                  "the suite has no method 'hyperbol' (did you mean 'hyperbola'?); --command NAME=PROGRAM adds one",
                  "--methods", "hyperbol")
    check_refused(context, good, "--conditions: ", "did you mean 'lossy'?", "--conditions", "losy")
    check_refused(context, "no_suite.yaml", "no_suite.yaml", "")
    result = context.run("bench")
    check_equal(result.code, 2, "exit code without a suite")
    check_in("SUITE", result.err, "stderr without a suite")


if __name__ == "__main__":
    main()
