#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`--json` of each command with results: the printed JSON equals the written files."""

import contextlib
import json
import re
import signal
import subprocess
import urllib.request

from common import case, check, check_equal, check_in, clean_environment, main, read_csv, read_json, words


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
            (("compare", run, run), "compare.json"),
            (("sweep", sweep, "--no-page"), "results.json")):
        folder = out / f"of_{arguments[0]}"
        printed = json.loads(context.run_well(*arguments, "--json", "--out", folder).out)
        check_equal(printed, read_json(folder / file), words(arguments))
    status = json.loads(context.run_well("sweep", "--status", out / "of_sweep", "--json").out)
    check_equal((status["runs"], status["done"], status["failed"]), (2, 2, 0), "status")
    merged = json.loads(context.run_well("sweep", "--merge", out / "of_sweep", "--json").out)
    check_equal(merged, read_json(out / "of_sweep/results.json"), "merged")
    profile = out / "profile.yaml"
    calibrated = json.loads(context.run_well("calibrate", run, "--tags", truth, "--out", profile, "--json").out)
    check_equal(list(calibrated["antennas"]), ["mobile"], "calibrated")
    check_in(f"phase_sign: {calibrated['antennas']['mobile']['phase_sign']}", profile.read_text(encoding="utf-8"),
             "profile")
    for arguments in (("run", warehouse, "--record-only", "--json"), ("track", run / "reads.csv", "--poses",
                      run / "antenna_poses.csv", "--allow-outside"), ("localize", run, "--skip-missing")):
        check_equal(context.run(*arguments).code, 2, words(arguments))


@case
def every_command_takes_it(context):
    names = re.findall(r"^  (\w+)  ", context.run_well("--help").out.split("Subcommands:")[-1], re.MULTILINE)
    check(len(names) > 20, f"commands: {names}")
    for name in names:
        help_text = " ".join(context.run_well(name, "--help").out.split())
        check(re.search(r"--json (Excludes: \S+ )?Print JSON for machines instead of text", help_text), f"{name}: {help_text}")
    lines = context.run_well("stream", context.shipped("portal"), "--speed", "0", "--json").out
    check_equal(lines, context.run_well("stream", context.shipped("portal"), "--speed", "0").out, "stream")
    for shell in ("bash", "zsh", "fish"):
        printed = json.loads(context.run_well("completion", shell, "--json").out)
        check_equal(printed, {"shell": shell, "script": context.run_well("completion", shell).out}, shell)
    written = json.loads(context.run_well("completion", "bash", "--out", "script", "--json").out)
    check_equal(written, {"shell": "bash", "file": "script"}, "completion --out")
    page = json.loads(context.run_well("man", "run", "--json").out)
    check_equal(page, {"page": context.run_well("man", "run").out}, "man")
    (context.folder / "pages").mkdir()
    pages = json.loads(context.run_well("man", "--out", context.folder / "pages", "--json").out)["files"]
    check_equal(sorted(pages), sorted(map(str, (context.folder / "pages").iterdir())), "man --out")


@case
def written_files_are_named(context):
    made = json.loads(context.run_well("new", context.folder / "hall", "--json").out)
    check_equal(made, {"folder": str(context.folder / "hall"), "files": [
        str(context.folder / "hall" / name) for name in ("hall.yaml", "hall.sdf", "analyse.py")]}, "new")
    run = context.folder / "run"
    context.run_well("run", context.folder / "hall/hall.yaml", "--out", run)
    (run / "report.html").unlink()
    drawn = json.loads(context.run_well("report", run, "--json").out)
    check_equal(drawn, {"page": f"{run}/report.html"}, "report")
    check((run / "report.html").is_file(), "there is no page")
    world = context.folder / "hall.world"
    written = json.loads(context.run_well("gazebo", context.folder / "hall/hall.yaml", "--out", world, "--json").out)
    check_equal(written["world"], str(world), "gazebo")
    check_equal(list(written["environment"]), ["GAZEBO_MODEL_PATH"], "environment of gazebo")
    converted = json.loads(context.run_well("gazebo", world, "--gz", "--out", context.folder / "hall.sdf", "--json").out)
    check_equal(converted, {"world": str(context.folder / "hall.sdf"), "environment": {}}, "gazebo --gz of a world")


@contextlib.contextmanager
def started(context, *arguments):
    """The first output of a server, as JSON."""
    command = [str(word) for word in (context.tagfield, *arguments, "--http", "0", "--json")]
    with subprocess.Popen(command, cwd=context.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, env=clean_environment()) as process:
        try:
            yield json.loads(process.stdout.readline())
        finally:
            process.send_signal(signal.SIGTERM)
            check_equal(process.wait(timeout=30), 0, f"exit code of {words(arguments)}")


@case
def servers_say_where_they_are(context):
    portal = context.shipped("portal")
    with started(context, "serve", portal, "--llrp", "0") as addresses:
        with urllib.request.urlopen(f"{addresses['http']}/api/status", timeout=20) as answer:
            check_equal(json.load(answer)["mode"], "live", "what answers at the address")
        check_equal([sorted(reader) for reader in addresses["llrp"]], [["address", "port", "reader"]], "llrp")
        check(addresses["llrp"][0]["port"] > 0, f"port {addresses['llrp'][0]['port']}")
    run = context.simulate("portal", "--no-page")
    with started(context, "view", run) as addresses:
        with urllib.request.urlopen(f"{addresses['http']}/api/status", timeout=20) as answer:
            check_equal(json.load(answer), {"mode": "recorded"}, "what answers at the address of a run")


if __name__ == "__main__":
    main()
