#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`tagfield calibrate` end to end: a log with known errors, the estimated profile, its use."""

import math
import statistics

from common import (case, check, check_equal, check_in, check_near, main, position, read_csv)

LEVER = (0.03, -0.04, 0.0)
LATE_S = 0.02
KNOWN = 6


def turned(quaternion, vector):
    """The vector rotated by the quaternion (x, y, z, w)."""
    x, y, z, w = quaternion
    u, v, t = vector
    # v + 2 q × (q × v + w v)
    cross = (y * t - z * v + w * u, z * u - x * t + w * v, x * v - y * u + w * t)
    return (u + 2 * (y * cross[2] - z * cross[1]), v + 2 * (z * cross[0] - x * cross[2]),
            t + 2 * (x * cross[1] - y * cross[0]))


def write_faulty(context, run):
    """The run's log with an error in the antenna's mounting position and in the clock."""
    rows = ["stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw"]
    for row in read_csv(run / "antenna_poses.csv"):
        quaternion = [float(row[key]) for key in ("qx", "qy", "qz", "qw")]
        shift = turned(quaternion, LEVER)
        place = [float(row[key]) - d for key, d in zip(("x_m", "y_m", "z_m"), shift)]
        rows.append(",".join([row["stamp_s"], row["antenna"], *(f"{v:.9f}" for v in place),
                              *(f"{v:.12f}" for v in quaternion)]))
    poses = context.write("poses.csv", "\n".join(rows) + "\n")
    rows = ["stamp_s,antenna,tag,frequency_hz,phase_rad,rssi_dbm"]
    for row in read_csv(run / "reads.csv"):
        rows.append(f"{float(row['stamp_s']) + LATE_S:.9f},{row['antenna']},{row['tag']},"
                    f"{row['frequency_hz']},{row['phase_rad']},{row['rssi_dbm']}")
    return context.write("reads.csv", "\n".join(rows) + "\n"), poses


def write_tags(context, run):
    rows = ["tag,x_m,y_m,z_m"]
    for row in sorted(read_csv(run / "truth/tags.csv"), key=lambda row: row["tag"])[:KNOWN]:
        rows.append(",".join([row["tag"], row["x_m"], row["y_m"], row["z_m"]]))
    return context.write("tags.csv", "\n".join(rows) + "\n")


def errors_of(run, located, known):
    """Errors of the located tags, without the known ones."""
    truth = {row["tag"]: position(row) for row in read_csv(run / "truth/tags.csv")}
    return [math.dist(position(row), truth[row["tag"]])
            for row in read_csv(located / "estimates.csv")
            if row["tag"] not in known and row["candidate"] == "1"]


@case
def a_calibration_finds_the_faults_and_takes_them_out(context):
    run = context.simulate("paper_warehouse", "--no-page")
    reads, poses = write_faulty(context, run)
    tags = write_tags(context, run)
    profile = context.folder / "profile.yaml"
    result = context.run_well("calibrate", reads, "--poses", poses, "--tags", tags, "--out", profile)
    check_in("phase grows with distance", result.out, "calibrate")
    text = profile.read_text(encoding="utf-8")
    for word in ("kind: calibration", "phase_centre_m", "time_offset_s", "noise_rad", "offsets"):
        check_in(word, text, "the profile")
    known = {row["tag"] for row in read_csv(tags)}
    common = ("localize", reads, "--poses", poses, "--scenario",
              context.shipped("paper_warehouse"))
    context.run_well(*common, "--out", context.folder / "before")
    context.run_well(*common, "--calibration", profile, "--out", context.folder / "after")
    before = errors_of(run, context.folder / "before", known)
    after = errors_of(run, context.folder / "after", known)
    check_equal(len(after), len(read_csv(run / "truth/tags.csv")) - KNOWN,
                "tags located with the calibration")
    # Without it, delayed stamps are detected, and no tag is located.
    check(not before or statistics.mean(after) < 0.5 * statistics.mean(before),
          f"errors before and after: {before} m, {after} m")
    check(statistics.mean(after) < 0.01, f"errors after: {after} m")
    again = context.folder / "again.yaml"
    context.run_well("calibrate", reads, "--poses", poses, "--tags", tags, "--threads", 1, "--out",
                     again)
    check_equal(again.read_bytes(), profile.read_bytes(), "the profile by one thread")


@case
def several_experiments_tell_what_carries_over(context):
    run = context.simulate("paper_warehouse", "--no-page")
    reads, poses = write_faulty(context, run)
    tags = write_tags(context, run)
    common = ("--poses", poses, "--tags", tags, "--out", context.folder / "profile.yaml")
    result = context.run_well("calibrate", reads, reads, reads, *common)
    check_in("position x      30.", result.out.replace("29.", "30."), "what is the same in all")
    two = context.run("calibrate", reads, reads, *common)
    check_equal(two.code, 2, "exit code of two")
    check_in("two experiments do not show what carries over", two.err, "stderr of two")
    wrong = context.run("calibrate", reads, reads, reads, "--poses", poses, *common)
    check_equal(wrong.code, 2, "exit code of two tables of poses for three experiments")
    check_in("--poses is given 2 times", wrong.err, "stderr")


@case
def bad_input_gives_one_line(context):
    reads = context.write("reads.csv", "stamp_s,antenna,tag,frequency_hz,phase_rad,rssi_dbm\n"
                                       "1,a,t,865.7e6,1,-50\n")
    poses = context.write("poses.csv", "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n"
                                       "0,a,0,0,1,0,0,0,1\n")
    twice = context.write("twice.csv", "tag,x_m,y_m,z_m\nt,1,2,3\nt,1,2,3\n")
    words = context.write("words.csv", "tag,x_m,y_m,z_m\nt,1,two,3\n")
    good = context.write("good.csv", "tag,x_m,y_m,z_m\nt,1,2,3\n")
    out = context.folder / "profile.yaml"
    for tags, says in ((twice, "twice.csv:3: tag 't' is listed twice"),
                       (words, "words.csv:2: y_m is 'two'"),
                       (context.folder / "none.csv", "none.csv"),
                       (good, "reads.csv: nothing to calibrate by")):
        result = context.run("calibrate", reads, "--poses", poses, "--tags", tags, "--out", out)
        check_equal(result.code, 2, f"exit code with {tags}")
        check_in(says, result.err, f"stderr with {tags}")
        check(not out.exists(), f"a profile by {tags}")
    for text, says in (("name: x\nkind: reader\nantennas: {}\n", ":2: kind"),
                       ("name: x\nkind: calibration\nantennas: {a: {phase_sign: 2}}\n",
                        "must be 1 or -1"),
                       ("name: x\nkind: calibration\nantennas: {a: {time_offset_s: {value: soon}}}\n",
                        ":3: antennas.a.time_offset_s.value"),
                       ("name: x\nkind: calibration\nantennas: {a: {noize_rad: 1}}\n", "noize_rad")):
        profile = context.write("bad.yaml", text)
        result = context.run("localize", reads, "--poses", poses, "--calibration", profile, "--out",
                             context.folder / "out")
        check_equal(result.code, 2, f"exit code with {text!r}")
        check_in(says, result.err, f"stderr with {text!r}")
        check_equal(result.err.count("\n"), 1, f"lines of {result.err!r}")


@case
def a_profile_by_hand_is_applied(context):
    # Half a metre along the antenna's x axis: poses must move by that.
    run = context.simulate("paper_warehouse", "--no-page")
    profile = context.write("hand.yaml", "name: by hand\nkind: calibration\nantennas:\n  mobile:\n"
                                         "    phase_centre_m: {x: {value: 0.5}, y: {value: 0},"
                                         " z: {value: 0}}\n")
    out = context.folder / "moved"
    context.run_well("localize", run / "reads.csv", "--poses", run / "antenna_poses.csv",
                     "--calibration", profile, "--out", out)
    before = read_csv(run / "antenna_poses.csv")
    after = read_csv(out / "antenna_poses.csv")
    for a, b in list(zip(before, after))[::100]:
        check_near(math.dist(position(a), position(b)), 0.5, 1e-6, "the antenna's shift")


if __name__ == "__main__":
    main()
