#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`tagfield track` end to end: a scenario, reads of a run, invalid input."""

import math

from common import (case, check, check_equal, check_in, check_near, files_in, main, read_csv,
                    read_json)

WRITTEN = ("tracks.csv", "verdicts.csv", "order.csv", "tracks.json", "tracks.svg", "tracks.html")


def track(context, *arguments, name="tracked"):
    folder = context.folder / name
    context.run_well("track", *arguments, "--out", folder)
    return folder


@case
def a_scenario_is_tracked_and_judged(context):
    folder = track(context, context.shipped("conveyor"))
    for name in (*WRITTEN, "reads.csv", "antenna_poses.csv", "truth/tags.csv"):
        check(name in files_in(folder), f"there is no {name}")
    summary = read_json(folder / "tracks.json")
    check_equal((summary["tracked"], summary["ambiguous"], summary["not_tracked"]), (12, 0, 0), "verdicts")
    check(summary["along_m"]["mean"] < 0.02, f"error along the track {summary['along_m']}")
    for order in summary["orders"]:
        check_equal(order["right"], order["pairs"], f"order at {order['passed']}")
    check_equal([order["passed"] for order in summary["orders"]], ["line", "gate_1", "gate_2"],
                "orders")


@case
def tracks_lie_where_the_scenario_moves_its_tags(context):
    folder = track(context, context.shipped("conveyor"))
    # From the scenario file: parcel_05 starts at x = -4.8, y = -0.05, at 1 m/s.
    rows = [row for row in read_csv(folder / "tracks.csv") if row["tag"] == "parcel_05"]
    check(len(rows) > 80, f"{len(rows)} rows")
    for row in rows:
        check_near(float(row["x_m"]), -4.8 + float(row["stamp_s"]), 0.08, "x_m")
        check_near(float(row["y_m"]), -0.05, 0.15, "y_m")
        check_near(float(row["vx_m_s"]), 1.0, 0.05, "vx_m_s")
        check(all(math.isfinite(float(value)) for key, value in row.items() if key != "tag"),
              f"not finite: {row}")
    order = [row for row in read_csv(folder / "order.csv") if row["passed"] == "line"]
    check_equal([row["tag"] for row in order], [f"parcel_{i:02}" for i in range(1, 13)], "order")
    for i, row in enumerate(order):
        check_near(float(row["stamp_s"]), 4.0 + 0.2 * i, 0.05, f"stamp of {row['tag']}")
    check_equal(order[-1]["before_next"], "", "before_next of the last")
    check(float(order[0]["before_next"]) > 0.99, f"before_next is {order[0]['before_next']}")


@case
def reads_of_a_run_give_the_same_tracks(context):
    scenario = context.shipped("conveyor")
    first = track(context, scenario, name="first")
    again = track(context, first / "reads.csv", "--poses", first / "antenna_poses.csv",
                  "--scenario", scenario, name="again")
    # Phases in files are rounded to six decimals.
    for a, b in zip(read_csv(first / "order.csv"), read_csv(again / "order.csv")):
        check_equal((a["passed"], a["tag"]), (b["passed"], b["tag"]), "order")
        check_near(float(a["stamp_s"]), float(b["stamp_s"]), 1e-5, f"stamp of {a['tag']}")
    by_options = track(context, first / "reads.csv", "--poses", first / "antenna_poses.csv", "--lane",
                       0, 0, 0, 0.1, "--line", 0, 0, 90, "--tag-height", 0.8, name="by_options")
    check_equal((by_options / "tracks.csv").read_bytes(), (again / "tracks.csv").read_bytes(),
                "tracks.csv by options")
    judged = read_json(by_options / "tracks.json")
    check(judged["along_m"]["mean"] < 0.02, "the truth beside the reads was not used to judge")


@case
def a_belt_that_may_speed_up_leaves_larger_errors(context):
    scenario = context.shipped("conveyor")
    errors = []
    for noise in (0, 0.5):
        folder = track(context, scenario, "--set", f"tracking.lane.acceleration_noise={noise}", name=f"noise_{noise}")
        errors.append([float(row["expected_error_m"]) for row in read_csv(folder / "verdicts.csv")])
    check(all(after > before for before, after in zip(*errors)), f"expected errors {errors}")


@case
def reads_that_do_not_fit_in_memory(context):
    """In parts on disk: identical tracks, and no leftovers."""
    scenario = context.shipped("conveyor")
    run = track(context, scenario, name="run")
    given = (run / "reads.csv", "--poses", run / "antenna_poses.csv", "--scenario", scenario)
    whole = track(context, *given, name="whole")
    parts = track(context, *given, "--part-reads", 2000, name="parts")
    for name in ("tracks.csv", "verdicts.csv"):  # The conveyor's tags are named in the order in which they come.
        check_equal((parts / name).read_bytes(), (whole / name).read_bytes(), name)
    check_equal((parts / "order.csv").read_bytes(), (whole / "order.csv").read_bytes(), "order.csv")
    of_whole, of_parts = read_json(whole / "tracks.json"), read_json(parts / "tracks.json")
    check_equal(of_parts["orders"], of_whole["orders"], "orders")
    for key in ("along_m", "across_m"):
        check(of_parts[key]["count"] <= 12 * 25, f"{key} is of {of_parts[key]['count']} stamps")
        check_near(of_parts[key]["mean"], of_whole[key]["mean"], 0.2 * of_whole[key]["mean"], key)
    for figure in ("tracks", "figures/passings", "figures/speeds"):
        check_equal((parts / f"{figure}.svg").read_bytes(), (whole / f"{figure}.svg").read_bytes(), figure)
    check_equal(sorted(path.name for path in context.folder.iterdir()), ["parts", "run", "whole"], "folders")
    bad = context.run("track", scenario, "--part-reads", 2000, "--out", context.folder / "bad")
    check_equal(bad.code, 2, "exit code with a scenario")
    check_in("--part-reads can only be used with CSV", bad.err, "what it says")


@case
def threads_and_seeds(context):
    scenario = context.shipped("conveyor")
    one = track(context, scenario, "--seeds", 2, "--threads", 1, name="one")
    two = track(context, scenario, "--seeds", 2, "--threads", 2, name="two")
    check_equal(files_in(one), files_in(two), "files by one and two threads")
    summary = read_json(one / "tracks.json")
    check_equal(summary["seeds"], [1, 2], "seeds")
    check_equal(summary["orders"][0]["pairs"], 22, "pairs of neighbours")


@case
def the_page_shows_gates_order_and_speeds(context):
    folder = track(context, context.shipped("conveyor"))
    page = (folder / "tracks.html").read_text(encoding="utf-8")
    for word in ('<figure id="tracks">', '<figure id="passings">', '<figure id="speeds">',
                 ">line that tags pass<", "12 of 12 tags tracked.", "first to last: parcel_01, parcel_02, parcel_03",
                 "at the line 11 of 11, at gate_1 11 of 11, at gate_2 11 of 11", "Passed gate_2",
                 "default-src 'none'"):
        check_in(word, page, "tracks.html")
    for word in ("src=", "http://", "https://", ">nan", "inf "):
        check(word not in page.split("<script>", 1)[0].lower(), f"tracks.html holds {word!r}")
    for name in ("figures/passings.svg", "figures/speeds.svg"):
        check(name in files_in(folder), f"there is no {name}")
    context.run_well("track", context.shipped("conveyor"), "--out", folder, "--no-page")
    check(not (folder / "tracks.html").exists(), "the page of an older run is still there")


@case
def names_on_the_page_are_text(context):
    name = "<script>hit()</script>"
    reads = context.write("reads.csv", "stamp_s,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n"
                                       f"1,a,{name},865.7e6,1,-50\n")
    poses = context.write("poses.csv", "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n0,a,0,0,1,0,0,0,1\n")
    page = (track(context, reads, "--poses", poses) / "tracks.html").read_text(encoding="utf-8")
    check("<script>hit" not in page, "a tag's name became a script")
    check_in("&lt;script&gt;hit()", page, "tracks.html")


@case
def a_run_of_the_conveyor_opens_with_what_was_measured(context):
    folder = context.simulate("conveyor")
    summary = read_json(folder / "summary.json")
    check_equal({tag["verdict"] for tag in summary["tags"]} & {"located"}, set(),
                "verdicts of moving tags")
    page = (folder / "report.html").read_text(encoding="utf-8")
    opening = page.split("</header>", 1)[0]
    check("located" not in opening, f"it opens with {opening[-300:]!r}")
    for word in ("12 of 12 tags read", "12 of 12 tags tracked", "first to last: parcel_01"):
        check_in(word, opening, "what the page opens with")
    check_in('<figure id="passings">', page, "report.html")
    tracked = track(context, context.shipped("conveyor"))
    for name in ("tracks.csv", "order.csv"):
        check_equal((folder / name).read_bytes(), (tracked / name).read_bytes(), f"{name} of run and of track")
    context.simulate("portal", "--no-page")
    check(not (folder / "tracks.json").exists(), "tracks of another run are still there")


@case
def bad_input_gives_one_line(context):
    reads = context.write("reads.csv", "stamp_s,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n"
                                       "1,a,t,865.7e6,1,-50\n")
    poses = context.write("poses.csv", "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n"
                                       "0,a,0,0,1,0,0,0,1\n")
    for arguments, says in (
            ((reads,), "track: reads as CSV need --poses FILE"),
            ((reads, "--poses", poses, "--seeds", 2), "--seeds can only be used with a scenario"),
            ((reads, "--poses", poses, "--bidirectional"), "--bidirectional can only be used with a lane"),
            ((reads, "--poses", poses, "--speed-range", 3, 1), "min_speed_m_s, 3 m/s, is over"),
            ((reads, "--poses", poses, "--method", "kalman"), "kalman"),
            ((context.shipped("conveyor"), "--poses", poses), "can only be used with reads"),
            ((context.shipped("conveyor"), "--set", "tracking.lane.width=1"), "width"),
            ((context.shipped("conveyor"), "--set", "tracking.lane.acceleration_noise=-1"), "acceleration_noise"),
            ((context.shipped("conveyor"), "--set", "tracking.reach_m=51"), "at most 50"),
            ((context.shipped("conveyor"), "--set", "tracking.particles=500"), "not used by ekf"),
            ((context.shipped("conveyor"), "--set", "tracking.method=kalman"), "tracking.method")):
        result = context.run("track", *arguments, "--out", context.folder / "bad")
        check_equal(result.code, 2, f"exit code of {arguments}")
        check_in(says, result.err, f"{arguments}")
        check_equal(result.err.count("\n"), 1, f"lines of {result.err!r}")
        check(not (context.folder / "bad").exists(), f"{arguments} leaves a folder")
    folder = track(context, reads, "--poses", poses)
    check_in("1 usable read, at least 12", (folder / "verdicts.csv").read_text(), "verdicts.csv")


@case
def keys_of_localization_alone_are_warned_of(context):
    for key, is_used in (("method=sar", False), ("max_rms_m=0.1", False), ("pi_ambiguity=false", True)):
        out = context.run_well("track", context.shipped("conveyor"), "--set", f"localization.{key}",
                               "--json")
        name = key.split("=")[0]
        warning = f"--set: localization.{name} has no effect on tracks"
        check_equal(warning in out.err, not is_used, f"a warning of {name}")


@case
def options_under_their_old_names(context):
    run = track(context, context.shipped("conveyor"), name="run")
    reads = (run / "reads.csv", "--poses", run / "antenna_poses.csv")
    words = {"new": ("--speed-range", "2,3"), "old": ("--speed", 2, 3)}  # The parcels run at 1 m/s.
    warned = {name: context.run_well("track", *reads, *word, "--out", context.folder / name).err
              for name, word in words.items()}
    for name in words:
        rows = read_csv(context.folder / name / "verdicts.csv")
        check_equal([row["verdict"] for row in rows], ["not_tracked"] * 12, f"{name}: verdicts")
        check(any("less than the minimum speed of 2 m/s" in row["reason"] for row in rows), f"{name}: no reason is the speed")
    check_in("--speed MIN MAX is now --speed-range", warned["old"], "what the old name is warned of")
    check("--speed" not in warned["new"], f"warned of the new name: {warned['new']}")


@case
def help_teaches(context):
    result = context.run_well("track", "--help")
    for word in ("READS", "--lane", "--line", "--speed-range", "--method", "ekf", "particle", "--seeds",
                 "tracks.csv", "order.csv", "tracks.html", "--no-page", "mirror image", "--acceleration-noise"):
        check_in(word, result.out, "track --help")


if __name__ == "__main__":
    main()
