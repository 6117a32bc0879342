#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`tagfield compare`: two runs side by side."""

import json

from common import case, check, check_equal, check_in, check_near, main, read_csv, read_json

SCENARIO = "paper_warehouse"


@case
def sets_errors_side_by_side_tag_by_tag(context):
    first = context.simulate(SCENARIO, "--no-page")
    second = context.folder / "second"
    context.run_well("localize", first, "--method", "sar", "--out", second)
    out = context.folder / "both"
    result = context.run_well("compare", first, second, "--out", out)
    check_in("mean error [mm]", result.out, "table")
    check_in(f"page: {out}/compare.html", result.out, "page")
    # Results of 'localize' are evaluated as by 'score'.
    scored = context.run_well("score", second / "estimates.csv", "--run", first, "--json")
    summaries = [read_json(first / "summary.json"), json.loads(scored.out)]
    errors = [{tag["id"]: tag["error_m"] for tag in summary["tags"]} for summary in summaries]
    rows = read_csv(out / "compare.csv")
    check_equal(sorted(row["tag"] for row in rows), sorted(errors[0]), "tags")
    both = []
    for row in rows:
        for of_run, column in zip(errors, ("first_error_m", "second_error_m")):
            expected = of_run[row["tag"]]
            check_equal(row[column] == "", expected is None, f"{row['tag']}: {column}")
            if expected is not None:
                check_near(float(row[column]), expected, 1e-6, f"{row['tag']}: {column}")
        if row["difference_m"]:
            both.append(float(row["difference_m"]))
    data = read_json(out / "compare.json")
    check_equal(data["error_difference_m"]["tags"], len(both), "pairs")
    check_near(data["error_difference_m"]["mean"], sum(both) / len(both), 1e-6, "mean difference")
    for name in ("compared_errors", "compared_places"):
        check((out / f"figures/{name}.svg").exists(), name)
    again = context.run_well("compare", first, second, "--json", "--out", context.folder / "again")
    check_equal(json.loads(again.out), data, "JSON")
    check_equal(read_json(context.folder / "again/compare.json"), data, "compare.json beside it")
    # Writing again into the same folder gives the same bytes.
    page = (out / "compare.html").read_bytes()
    context.run_well("compare", first, second, "--out", out)
    check_equal((out / "compare.html").read_bytes(), page, "page")


@case
def of_a_run_with_itself_nothing_differs(context):
    run = context.simulate(SCENARIO, "--no-page")
    comparison = json.loads(context.run_well("compare", run, run, "--json").out)
    check_equal(comparison["error_difference_m"]["mean"], 0, "mean")
    check_equal(comparison["error_difference_m"]["smaller"], 0, "smaller")
    check_equal(comparison["warnings"], [], "warnings")


@case
def inventories_are_compared_by_the_reads_of_a_run(context):
    arguments = ("--seeds", "3", "--no-page", "--set", "localization.method=none")
    folders = [context.simulate(SCENARIO, *arguments, name="first"),
               context.simulate(SCENARIO, *arguments, "--set", "antennas.*.range_m=1.5",
                                name="second")]
    out = context.folder / "inventories"
    printed = context.run_well("compare", *folders, "--out", out).out
    check("located" not in printed and "error" not in printed, printed)
    words = next(line for line in printed.splitlines() if line.startswith("tags read")).split()
    inventories = [read_json(folder / "summary.json")["inventory"] for folder in folders]
    check(inventories[0]["reads"] > inventories[1]["reads"], f"reads: {inventories}")
    for i, inventory in enumerate(inventories):
        check_near(float(words[2 + 3 * i]), inventory["read"], 0.05, f"tags read of {words}")
        check_equal(int(words[4 + 3 * i]), inventory["tags"], f"tags of {words}")
    check("Tags located" not in (out / "compare.html").read_text(), "page")


@case
def what_cannot_be_compared_is_one_line(context):
    run = context.simulate(SCENARIO, "--no-page")
    strangers = context.write("strangers.yaml", "name: strangers\nduration_s: 1\n"
                              "antennas:\n  - {name: a, pose: [0, 0, 1]}\n"
                              "tags:\n  - {id: stranger, position: [1, 0, 1]}\n")
    other = context.simulate(strangers, "--no-page", name="strangers")
    empty = context.folder / "empty"
    empty.mkdir()
    for expected, arguments in (("no such folder", (run, context.folder / "missing")),
                                ("holds no summary.json", (run, empty)),
                                ("holds a run", (run, run, "--out", run)),
                                ("no tag in common", (run, other))):
        result = context.run("compare", *arguments)
        check_equal(result.code, 2, expected)
        check_in(expected, result.err, "message")
        check_equal(len(result.err.strip().splitlines()), 1, f"lines of {result.err!r}")
    check_equal(list(empty.iterdir()), [], "written")
    check((run / "reads.csv").exists(), "the run")


if __name__ == "__main__":
    main()
