#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`--json` of each command that has results: what it prints is what it writes."""

import json

from common import case, check_equal, check_in, main, read_csv, read_json, words


@case
def json_is_what_the_files_hold(context):
    warehouse, out = context.shipped("paper_warehouse"), context.folder
    run = out / "run"
    context.run_well("run", warehouse, "--out", run, "--no-page")
    truth = context.write("tags.csv", "tag,x_m,y_m,z_m\n" + "".join(
        f"{row['tag']},{row['x_m']},{row['y_m']},{row['z_m']}\n" for row in read_csv(run / "truth/tags.csv")))
    suite = context.write("suite.yaml", f"scenario: {warehouse}\nmethods: [hyperbola]\n"
                          "conditions:\n  - {name: true pose}\n")
    sweep = context.write("sweep.yaml", f"scenario: {warehouse}\nmethods: [hyperbola]\nseeds: 1\n"
                          "sweep: {grid: {pose.sigma_m: [0.01, 0.02]}}\n")
    for arguments, file in (
            (("run", warehouse, "--no-page"), "summary.json"),
            (("localize", run), "summary.json"),
            (("track", context.shipped("conveyor"), "--no-page"), "tracks.json"),
            (("coverage", warehouse, "--height", "1", "--step", "1"), "coverage.json"),
            (("plan", context.shipped("plan/aisle"), "--no-links"), "plan.json"),
            (("bench", suite, "--no-page"), "bench.json"),
            (("sweep", sweep, "--no-page"), "results.json")):
        folder = out / f"of_{arguments[0]}"
        told = json.loads(context.run_well(*arguments, "--json", "--out", folder).out)
        check_equal(told, read_json(folder / file), words(arguments))
    status = json.loads(context.run_well("sweep", "--status", out / "of_sweep", "--json").out)
    check_equal((status["runs"], status["done"], status["failed"]), (2, 2, 0), "status")
    merged = json.loads(context.run_well("sweep", "--merge", out / "of_sweep", "--json").out)
    check_equal(merged, read_json(out / "of_sweep/results.json"), "merged")
    profile = out / "profile.yaml"
    told = json.loads(context.run_well("calibrate", run, "--tags", truth, "--out", profile, "--json").out)
    check_equal(list(told["antennas"]), ["mobile"], "calibrated")
    check_in(f"phase_sign: {told['antennas']['mobile']['phase_sign']}", profile.read_text(encoding="utf-8"),
             "profile")
    for arguments in (("run", warehouse, "--record-only", "--json"), ("track", run / "reads.csv", "--poses",
                      run / "antenna_poses.csv", "--allow-outside"), ("localize", run, "--skip-missing")):
        check_equal(context.run(*arguments).code, 2, words(arguments))


if __name__ == "__main__":
    main()
