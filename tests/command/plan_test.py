#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`tagfield plan`, inventories, and runs without some antennas: outputs, resuming, invalid input."""

import base64
import hashlib
import re

from common import case, check, check_equal, check_in, files_in, main, read_csv, read_json

STORE = """name: store
model: link_budget
duration_s: 2
plan:
  tags:
    - {name: shelf, zone: sales, box: [0, 0, 0.5, 4, 2, 1.5], spacing_m: [1, 1, 1],
       orientations: any, count: 40}
  mounts:
    - {name: ceiling, surface: [[0, 0, 3], [4, 0, 3], [0, 2, 3]], spacing_m: 2, rpy_deg: [[0, 90, 0]],
       cost: 100, powers_dbm: [20], profiles: [speedway_r420, panel_6dbi]}
  limits: {antennas: 3, readers: 1, ports: 4}
"""

ROOM = """name: room
model: link_budget
duration_s: 2
antennas:
  - {name: west_1, reader: west, pose: [0, 0, 2, 0, 1.2, 0], profiles: [speedway_r420, panel_6dbi]}
  - {name: west_2, reader: west, pose: [0, 2, 2, 0, 1.2, 0], profiles: [speedway_r420, panel_6dbi]}
  - {name: east_1, reader: east, pose: [4, 1, 2, 0, 1.2, 3.1416], profiles: [speedway_r420, panel_6dbi]}
tag_table: tags.csv
"""
TABLE = "tag,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,profile\n" + "".join(
    f"t{i},{0.5 + i % 4},{i // 4 % 3},0.8,0,0,{0.3 * i:.2f},monza_r6\n" for i in range(24))


def room(context):
    context.write("tags.csv", TABLE)
    return context.write("room.yaml", ROOM)


@case
def a_plan_is_a_folder_and_its_layout_runs(context):
    path = context.write("store.yaml", STORE)
    out = context.folder / "plan"
    arguments = ("plan", path, "--samples", "8", "--check", "3", "--out", out)
    said = context.run_well(*arguments).out
    check_in("<- chosen", said, "what is said")
    check_in("checked: ", said, "what is said")
    plan = read_json(out / "plan.json")
    check_equal(len(plan["layouts"]), 3, "layouts")
    check_equal(plan["chosen_antennas"], 3, "chosen")
    for layout in plan["layouts"]:
        check(layout["score"] <= layout["bound"] + 1e-9, "bound")
    check_equal(len(read_csv(out / "plan_layouts.csv")), 3, "rows of layouts")
    check_equal(len(read_csv(out / "plan_antennas.csv")), 6, "rows of antennas")
    check_equal(len(read_csv(out / "plan_positions.csv")), 30, "rows of places")
    before = files_in(out)
    # Cached links give the same result, with any number of threads.
    context.run_well(*arguments, "--threads", "1")
    check(files_in(out) == before, "files differ when planned again")
    run = context.folder / "run"
    context.run_well("run", out / "layout.yaml", "--out", run)
    inventory = read_json(run / "summary.json")["inventory"]
    check_equal(inventory["tags"], 40, "tags of the layout")
    check_equal(inventory["zones"][0]["zone"], "sales", "zone")


@case
def aims_at_reads_and_at_places(context):
    path = context.write("store.yaml", STORE)
    out = context.folder / "plan"
    said = context.run_well("plan", path, "--samples", "8", "--out", out, "--set", "plan.aim={dwell_reads: 4}").out
    check_in("tags counted are those read at least 4 times in", said, "what is said")
    plan = read_json(out / "plan.json")
    check_equal((plan["aim_dwell_reads"], plan["aim_read_probability"]), (4, None), "aims")
    chosen = plan["layouts"][plan["chosen_antennas"] - 1]
    check(abs(chosen["share"] - chosen["read"]["mean"] / plan["tags"]) < 1e-9, "share of the tags")
    context.run_well("plan", context.shipped("plan/room"), "--samples", "8", "--check", "2", "--out",
                     context.folder / "room")
    plan = read_json(context.folder / "room/plan.json")
    check_equal((plan["chosen_antennas"], plan["reaches_aim"], plan["check"]["inside"]), (3, True, 2), "room")
    places = read_csv(context.folder / "room/plan_positions.csv")
    # With two antennas, each tag has two possible positions.
    check(all(place["error_m_2"] == "" for place in places), "errors by two antennas")
    check(all(0.0 < float(place["error_m_3"]) < 0.03 for place in places), "errors by three")
    page = (context.folder / "room/plan.html").read_text(encoding="utf-8")
    check_in("locatable to within 0.03 m", page, "page")


@case
def scripts_run_by_their_hash(context):
    path = context.write("store.yaml", STORE)
    out = context.folder / "plan"
    context.run_well("plan", path, "--samples", "8", "--out", out)
    page = (out / "plan.html").read_text(encoding="utf-8")
    allowed = re.findall(r"'(sha256-[^']+)'", page.split("script-src", 1)[1].split(";", 1)[0])
    scripts = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    check_equal(len(scripts), 4, "scripts")
    for script in scripts:
        digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
        check_in("sha256-" + digest, allowed, "hashes that the page lets run")
    for word in ("http://", "https://", "nan", "inf<"):
        check(word not in page, f"{word} in the page")


@case
def an_inventory_is_a_result(context):
    path = room(context)
    out = context.folder / "out"
    said = context.run_well("run", path, "--leave-one-out", "--out", out).out
    check_in("inventory: ", said, "what is said")
    check_in("no positions: all antennas stand still", said, "what is said")
    summary = read_json(out / "summary.json")
    inventory = summary["inventory"]
    check_equal(summary["method"], "none", "method")
    check_equal([row["name"] for row in inventory["readers"]], ["west", "east"], "readers")
    check_equal([row["antenna"] for row in inventory["without"]], ["west_1", "west_2", "east_1"],
                "antennas left out")
    tags = {row["tag"] for row in read_csv(out / "reads.csv")}
    check_equal(inventory["read"], len(tags), "tags read")
    page = (out / "report.html").read_text(encoding="utf-8")
    check(page.index("Tags read") < page.index("By antenna"), "the numbers come first")
    check("located" not in page.split("<main>", 1)[0], "no word of places in the header")


@case
def antennas_by_pattern(context):
    path = room(context)
    out = context.folder / "out"
    context.run_well("run", path, "--without", "west_*", "--out", out, "--no-page")
    names = [row["name"] for row in read_json(out / "summary.json")["inventory"]["antennas"]]
    check_equal(names, ["east_1"], "antennas that are left")
    context.run_well("run", path, "--set", "antennas.west_*.transmit_power_dbm=1", "--set",
                     "antennas.east_1.transmit_power_dbm=1", "--out", out, "--no-page")
    check(read_json(out / "summary.json")["inventory"]["read"] < 3, "hardly any power is left")
    context.run_well("coverage", path, "--antenna", "west_*", "--step", "1", "--out",
                     context.folder / "coverage")
    coverage = read_json(context.folder / "coverage/coverage.json")
    check_equal([row["name"] for row in coverage["antennas"]], ["west_1", "west_2"], "antennas")


@case
def coverage_says_what_the_run_reads(context):
    path = room(context)
    context.run_well("coverage", path, "--step", "1", "--out", context.folder / "coverage")
    expected = read_json(context.folder / "coverage/coverage.json")["expected_read"]
    read = []
    for seed in range(1, 6):
        out = context.folder / f"out{seed}"
        context.run_well("run", path, "--seed", str(seed), "--out", out, "--no-page")
        read.append(read_json(out / "summary.json")["inventory"]["read"])
    inside = [one for one in read if expected["low"] <= one <= expected["high"]]
    check(len(inside) >= 4, f"{read} are not within {expected}")


@case
def a_plan_knows_what_stands_in_the_way(context):
    path = context.write("dock.yaml", """\
name: dock
model: link_budget
duration_s: 2
tag_profile: monza_r6
obstacles:
  - {name: stack, size: [0.1, 8], position: [1.5, 0], material: metal, height_m: 4}
tags:
  - {id: late, position: [3, 0.5, 1], appears_s: 1}
plan:
  tags:
    - {name: pallet, points: [[3, 0, 1], [3, 1, 1]]}
  mounts:
    - {name: blocked, points: [[0, 0, 1]], rpy_deg: [[0, 0, 0]], powers_dbm: [29],
       profiles: [speedway_r420, panel_6dbi]}
    - {name: free, points: [[6, 0, 1]], rpy_deg: [[0, 0, 180]], powers_dbm: [20],
       profiles: [speedway_r420, panel_6dbi]}
  limits: {antennas: 1, cross_reads: 0.1}
""")
    out = context.folder / "plan"
    slip = context.run_well("plan", context.write("store.yaml", STORE.replace("cost: 100", "zone: sale, cost: 100")),
                            "--samples", "8", "--out", context.folder / "slip")
    check_in("zone 'sales' of the tags 'shelf': no mount is for it", slip.err, "stderr of a slip")
    result = context.run_well("plan", path, "--samples", "8", "--check", "2", "--out", out)
    check_in("plan.limits.cross_reads has no effect: no tags are in a zone", result.err, "stderr")
    check_in("1 of the scenario's tags appear later or disappear", result.err, "stderr")
    check_in("name: free", (out / "layout.yaml").read_text(), "layout")
    check_equal(read_json(out / "plan.json")["check"]["inside"], 2, "runs within the range")


@case
def another_scenarios_results_stay(context):
    path = context.write("store.yaml", STORE)
    out = context.folder / "out"
    context.run_well("plan", path, "--samples", "8", "--out", out)
    before = files_in(out)
    result = context.run("run", room(context), "--out", out)
    check_equal(result.code, 2, "exit code")
    check_in("holds results of the scenario 'store', not of 'room'", result.err, "stderr")
    check(files_in(out) == before, "files changed")
    context.run_well("run", room(context), "--out", out, "--force", "--no-page")


@case
def bad_plans(context):
    out = context.folder / "out"
    for change, says in (
            (("antennas: 3", "cost: 10"), "plan.limits.cost allows no antenna"),
            (("0.5, 4, 2, 1.5]", "0.5, 4, 2]"), "6 numbers"),
            (("rpy_deg: [[0, 90, 0]]", "rpy_deg: [[0, 90]]"), "rpy_deg"),
            (("ports: 4", "ports: 0"), "must be from 1 to 256"),
            (("model: link_budget", "model: paper"), "needs model: link_budget"),
            (("panel_6dbi", "panel_7dbi"), "did you mean 'panel_6dbi'"),
            (("plan:", "plann:"), "unknown key 'plann'")):
        path = context.write("bad.yaml", STORE.replace(*change))
        result = context.run("plan", path, "--out", out)
        check_equal((result.code, result.err.count("\n")), (2, 1), f"code and lines of {change}")
        check_in(says, result.err, f"stderr of {change}")
    path = context.write("store.yaml", STORE)
    for arguments, says in ((["--samples", "1"], "samples"), (["--exact", "0"], "exact"),
                            (["--set", "plan.aim={dwell_reads: 2, position_error_m: 1}"], "expected one of them"),
                            (["--set", "plan.aim.dwell_reads=0.5"], "must be at least 1"),
                            (["--exact", "1", "--set", "plan.aim.position_error_m=1"], "no exact solution"),
                            (["--set", "plan.mounts.roof.cost=1"], "no element 'roof'")):
        result = context.run("plan", path, *arguments, "--out", out)
        check_equal(result.code, 2, f"exit code of {arguments}")
        check_in(says, result.err, f"stderr of {arguments}")


@case
def without_antennas_it_is_to_be_planned_first(context):
    for text in (STORE, STORE.replace("plan:", "tag_profile: monza_r6\nplan:")):
        path = context.write("store.yaml", text)
        for command in ("run", "coverage"):
            result = context.run(command, path, "--out", context.folder / "out")
            check_equal((result.code, result.err.count("\n")), (2, 1), f"code and lines of {command}")
            check_in("no antennas", result.err, f"stderr of {command}")
            check_in("'tagfield plan'", result.err, f"stderr of {command}")


if __name__ == "__main__":
    main()
