#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""`tagfield localize` of tables: all methods, prior knowledge, and reads like those of real readers:
different clocks, gaps, duplicates, disorder, several carriers.

The reads are synthetic, by eq. 3 of the paper along an S-shaped path, so that the positions are known.
"""

import cmath
import filecmp
import json
import math
import os
import random
import resource
import tarfile

from common import (SPEED_OF_LIGHT, Skip, case, check, check_equal, check_in, check_near, files_in, main,
                    position, read_csv, read_json)

METHODS = ("auto", "hyperbola", "ml", "joint", "sar")
CARRIER = 865.7e6
HEIGHT = 1.0
TAGS = {"one": (2.0, 2.5, HEIGHT), "two": (4.5, 2.8, HEIGHT), "three": (3.0, -1.5, HEIGHT)}
ANTENNA = "a"


def path(seconds):
    """The antenna's position at a time [s], on an S-shaped path at about 0.3 m/s."""
    x = 0.28 * seconds
    return x, 0.5 * math.sin(x), HEIGHT


def pose_rows(antenna=ANTENNA, begin=0.0, end=24.0, shift=0.0, error=lambda seconds: (0.0, 0.0)):
    """Rows of a table of poses at 15 Hz, with the position error `error`."""
    rows = []
    for i in range(int(round(begin * 15)), int(round(end * 15)) + 1):
        x, y, z = path(i / 15)
        dx, dy = error(i / 15)
        rows.append(f"{i / 15 + shift:.6f},{antenna},{x + dx:.6f},{y + dy:.6f},{z},0,0,0,1")
    return rows


def read_rows(tags, antenna=ANTENNA, shift=0.0, carrier=lambda i: CARRIER, offset=0.0):
    """Rows of a table of reads at 15 Hz, in order of time."""
    noise = random.Random(4)
    rows = []
    for i in range(15 * 24):
        place = path(i / 15)
        for tag, at in tags.items():
            distance = math.dist(place, at)
            phase = (4 * math.pi * distance * carrier(i) / SPEED_OF_LIGHT + offset +
                     noise.gauss(0, 0.05)) % (2 * math.pi)
            rssi = -40 - 40 * math.log10(distance)
            rows.append(f"{i / 15 + shift:.6f},r,{antenna},{tag},{carrier(i):.0f},{phase:.6f},"
                        f"{rssi:.1f}")
    return rows


def localize(context, reads, poses, *arguments, covariance=False):
    """Runs localize; returns the result, the estimates by tag (best candidate), and summary.json."""
    more = ",cov_xx,cov_xy,cov_xyaw,cov_yy,cov_yyaw,cov_yawyaw" if covariance else ""
    context.write("reads.csv", "\n".join(
        ["stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm", *reads]) + "\n")
    context.write("poses.csv", "\n".join(
        ["stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw" + more, *poses]) + "\n")
    if not {"--tag-height", "--tag-heights", "--vertical-side", "--scenario"} & set(arguments):
        arguments = ("--tag-height", f"{HEIGHT}", *arguments)
    result = context.run_well("localize", "reads.csv", "--poses", "poses.csv", "--out", "out",
                              *arguments)
    check("warning" in result.err or result.err == "", f"stderr: {result.err!r}")
    estimates = {}
    for row in read_csv(context.folder / "out/estimates.csv"):
        estimates.setdefault(row["tag"], row)
    return result, estimates, read_json(context.folder / "out/summary.json")


def check_located(estimates, tags, method, most=0.02):
    for tag in tags:
        row = estimates[tag]
        if check_equal(row["verdict"], "located", f"{method}: verdict on {tag} ({row['reason']})"):
            check_near(math.dist(position(row), TAGS[tag]), 0.0, most, f"{method}: error of {tag}")


def check_hopeless(estimates, tag, why, method):
    check_equal(estimates[tag]["verdict"], "not_located", f"{method}: verdict on {tag}")
    check_in(why, estimates[tag]["reason"], f"{method}: reason of {tag}")


# --- Methods --------------------------------------------------------------------------------------

@case
def every_method_by_name(context):
    context.write("empty", "")
    listed = context.run_well("bench", "--list-methods").out.splitlines()
    help_text = context.run_well("localize", "--help").out
    for line in listed:
        check_in(line, help_text, "localize --help")
    # Each method is followed by its settings.
    names = [line.split()[0] for line in listed if not line.startswith(" ")]
    for name in names:
        _, _, summary = localize(context, read_rows(TAGS), pose_rows(), "--method", name,
                                 "--pose-sigma", "0")
        check_equal(summary["method_asked"], name, "method_asked")
        check_equal(summary["method"] in names and summary["method"] != "auto", True,
                    f"{summary['method']} as the method of {name}")
    wrong = context.run("localize", "reads.csv", "--poses", "poses.csv", "--method", "hyprbola")
    check_equal(wrong.code, 2, "exit code")
    check_in("--method: there is no method 'hyprbola' (did you mean 'hyperbola'?)", wrong.err,
             "the complaint")


@case
def good_methods_locate(context):
    for method in METHODS:
        result, estimates, summary = localize(context, read_rows(TAGS), pose_rows(), "--method",
                                              method, "--pose-sigma", "0")
        check_located(estimates, TAGS, method)
        check_equal(summary["warnings"], [], f"{method}: warnings")
        check_in("1,080 reads of 3 tags by 1 antenna\n", result.out, "what is printed")


@case
def auto_says_what_it_took_and_why(context):
    for sigma, method in (("0", "ml"), ("0.01", "joint"), (None, "joint")):
        words = ["--pose-sigma", sigma] if sigma else []
        result, _, summary = localize(context, read_rows(TAGS), pose_rows(), *words)
        check_equal((summary["method"], summary["method_asked"]), (method, "auto"), "method")
        check_in(f"method: {method}, chosen by auto: {summary['method_why']}\n", result.out,
                 "what is printed")
        check(result.out.index("method:") < result.out.index("x [m]"), "not above the table")
        page = (context.folder / "out/report.html").read_text(encoding="utf-8")
        check_in("<dt>Chosen by auto</dt><dd>the pose is", page, "the page")
    _, _, summary = localize(context, read_rows(TAGS), pose_rows(), "--method", "ml")
    check_equal((summary["method_asked"], summary["method_why"]), ("ml", ""), "asked by name")


@case
def reads_without_phases_are_located_by_strength(context):
    context.write("poses.csv", "\n".join(["stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw",
                                          *pose_rows()]) + "\n")
    rows = ["stamp_s,antenna,tag,frequency_hz,rssi_dbm"]
    for row in read_rows(TAGS):
        stamp, _, antenna, tag, carrier, _, rssi = row.split(",")
        rows.append(",".join((stamp, antenna, tag, carrier, rssi)))
    reads = context.write("strengths.csv", "\n".join(rows) + "\n")
    result = context.run_well("localize", reads, "--poses", "poses.csv", "--tag-height", HEIGHT,
                              "--out", "out")
    check_in("method: trilateration, chosen by auto: the reads have no phases", result.out, "stdout")
    estimates = {row["tag"]: row for row in read_csv(context.folder / "out/estimates.csv")}
    check_located(estimates, TAGS, "trilateration", most=0.5)
    context.run_well("localize", reads, "--poses", "poses.csv", "--method", "sar", "--out", "out")
    for row in read_csv(context.folder / "out/estimates.csv"):
        check_equal(row["verdict"], "not_located", f"sar without phases: {row['tag']}")


@case
def a_portal_of_fixed_antennas(context):
    """A log like that of an LLRP reader in the FCC band, with RSSI falling by 34 dB per decade and phases
    with unknown offsets: tags are located by RSSI, and missing knowledge is reported."""
    noise = random.Random(3)
    corners = {"1": (0, 0), "2": (0, 4), "3": (4, 4), "4": (4, 0)}
    tags = {f"t{i}": (noise.uniform(0.3, 3.7), noise.uniform(0.3, 3.7)) for i in range(20)}
    rows = ["timestamp,antenna,rssi,epc,phase_angle,channel_index"]
    for tag, place in tags.items():
        for antenna, corner in corners.items():
            rssi = -45 - 34 * math.log10(math.dist(place, corner)) + noise.gauss(0, 2)
            for i in range(100):
                rows.append(f"{1 + 0.05 * i:.3f},{antenna},{rssi:.1f},{tag},"
                            f"{noise.randrange(4096)},{1 + i % 50}")
    log = context.write("log.csv", "\n".join(rows) + "\n")
    poses = context.write("portal.csv", "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n" + "".join(
        f"0,{name},{x},{y},1.2,0,0,0,1\n" for name, (x, y) in corners.items()))
    result = context.run_well("localize", log, "--format", "llrp_fcc", "--poses", poses,
                              "--tag-height", "1.2", "--box", 0, 0, 4, 4, "--out", "out")
    check_in("method: fixed, chosen by auto", result.out, "stdout")
    check_in("the phases are not used", result.err, "stderr")
    ratios = [math.dist(position(row)[:2], tags[row["tag"]]) / float(row["expected_error_m"])
              for row in read_csv(context.folder / "out/estimates.csv")
              if row["verdict"] == "located"]
    check(len(ratios) >= 15, f"{len(ratios)} of 20 located")
    check(all(ratio < 5 for ratio in ratios), f"error over expected: {ratios}")


# --- Prior knowledge ------------------------------------------------------------------------------

@case
def heights_are_estimated_on_a_side(context):
    tags = {tag: (x, y, HEIGHT + 0.6) for tag, (x, y, _) in TAGS.items()}
    for side, z in (("above", HEIGHT + 0.6), ("below", HEIGHT - 0.6)):
        _, estimates, _ = localize(context, read_rows(tags), pose_rows(), "--vertical-side", side,
                                   "--method", "ml", "--pose-sigma", "0")
        for tag, row in estimates.items():
            check_near(float(row["z_m"]), z, 0.05, f"height of {tag}, {side}")
            check(float(row["cov_zz"]) > 0, f"cov_zz of {tag} is {row['cov_zz']}")


@case
def tags_of_unknown_height_are_warned_of(context):
    """The warning counts tags without reference tags; there is none if all heights are known."""
    reads = read_rows(TAGS)
    context.write("known.csv", "tag,x_m,y_m,z_m\none,2,2.5,1\n")
    first, *others = (tag for tag in TAGS if tag != "one")
    context.write("some.csv", "tag,height_m\n" + "".join(f"{tag},{HEIGHT}\n" for tag in others))
    words = ("--tag-heights", "some.csv", "--method", "ml", "--pose-sigma", "0")
    result, _, _ = localize(context, reads, pose_rows(), *words, "--reference", "known.csv")
    check_in(f"the heights of 1 of {len(TAGS)} tags are not stated, such as '{first}'", result.err, "some heights")
    context.write("some.csv", "tag,height_m\n" + "".join(f"{tag},{HEIGHT}\n" for tag in TAGS))
    result, _, _ = localize(context, reads, pose_rows(), *words)
    check("height" not in result.err, f"all heights known: {result.err!r}")
    result = context.run_well("localize", "reads.csv", "--poses", "poses.csv", "--out", "out",
                              *words[2:])
    check_in("the tags' heights are not stated", result.err, "no height")


@case
def reference_tags_and_offsets(context):
    context.write("known.csv", "tag,x_m,y_m,z_m\none,2,2.5,1\n")
    result, estimates, summary = localize(context, read_rows(TAGS), pose_rows(), "--reference",
                                          "known.csv", "--pose-sigma", "0")
    check_equal(position(estimates["one"]), TAGS["one"], "place of the reference tag")
    check_in("its position was given", estimates["one"]["reason"], "reason")
    check_equal([tag["id"] for tag in summary["tags"] if tag["reference"]], ["one"], "references")
    check((context.folder / "out/reference_tags.csv").exists(), "no reference_tags.csv")
    check_equal(summary["located"], 2, "tags located, the reference tag aside")
    check_in("2 located, 0 ambiguous, 0 not located (1 reference tag given)", result.out, "result")
    # A known offset turns phases into distances: it reduces the covariance; a wrong one spoils the result.
    reads = read_rows(TAGS, offset=2.5)
    covariance = {}
    for words in ([], ["--offset", "2.5"], ["--offset", "a=2.5"]):
        _, estimates, _ = localize(context, reads, pose_rows(), *words, "--method", "ml",
                                   "--pose-sigma", "0")
        check_located(estimates, TAGS, words)
        covariance[len(words) and words[1]] = sum(float(row["cov_xx"]) + float(row["cov_yy"])
                                                  for row in estimates.values())
    check(covariance["2.5"] < 0.9 * covariance[0], f"variances are {covariance}")
    check_equal(covariance["2.5"], covariance["a=2.5"], "variance by the antenna's name")


@case
def covariances_stand_in_the_estimates(context):
    _, estimates, _ = localize(context, read_rows(TAGS), pose_rows(), "--pose-sigma", "0",
                               "--method", "ml")
    for tag, row in estimates.items():
        trace = float(row["cov_xx"]) + float(row["cov_yy"])
        check_near(math.sqrt(trace), float(row["expected_error_m"]), 1e-5, f"root of {tag}'s trace")
        check_equal(float(row["cov_zz"]), 0.0, f"cov_zz of {tag}, whose height was given,")
        check(float(row["cov_xy"]) ** 2 < float(row["cov_xx"]) * float(row["cov_yy"]),
              f"the covariance of {tag} is not positive")
    _, estimates, _ = localize(context, read_rows(TAGS), pose_rows(), "--method", "hyperbola")
    for tag, row in estimates.items():
        trace = float(row["cov_xx"]) + float(row["cov_yy"])
        check_near(math.sqrt(trace), float(row["expected_error_m"]), 1e-5, f"root of {tag}'s trace")


@case
def the_error_of_poses_is_estimated(context):
    def error(seconds):
        return 0.03 * math.sin(0.7 * seconds), 0.03 * math.cos(0.5 * seconds)
    tags = {f"t{i}": (0.7 * i, (2.0, -1.8, 2.6, -2.4)[i % 4], HEIGHT) for i in range(10)}
    reads = read_rows(tags)
    errors = {}
    covariances = [f"{row},0.0009,0,0,0.0009,0,0.0001" for row in pose_rows(error=error)]
    for name, poses, words in (
            ("exact", pose_rows(error=error), ["--pose-sigma", "0"]),
            ("given", pose_rows(error=error), ["--pose-sigma", "0.03", "--pose-time-constant", "2"]),
            ("unknown", pose_rows(error=error), []),
            ("covariances", covariances, [])):
        _, estimates, _ = localize(context, reads, poses, "--method", "joint", *words,
                                   covariance=poses is covariances)
        corrected = read_csv(context.folder / "out/corrected_poses.csv")
        check_equal(len(corrected), len(poses), f"{name}: corrected poses")
        errors[name] = math.sqrt(sum(
            math.dist(position(row), path(float(row["stamp_s"]))) ** 2 for row in corrected) /
            len(corrected))
    check_near(errors["exact"], 0.03, 0.006, "rms error of poses said to be exact")
    for name in ("given", "unknown", "covariances"):
        check(errors[name] < 0.5 * errors["exact"], f"{name}: rms errors are {errors}")


@case
def bad_words_for_what_is_known(context):
    localize(context, read_rows({"one": TAGS["one"]}), pose_rows())
    context.write("twice.csv", "tag,x_m,y_m,z_m\none,1,2,3\none,1,2,3\n")
    for words, says in ((["--vertical-side", "beside"], "--vertical-side"),
                        (["--circular", "round"], "--circular"),
                        (["--vertical-side", "above", "--tag-height", "1"], "--vertical-side"),
                        (["--offset", "half"], "expected RAD or ANTENNA=RAD"),
                        (["--offset", "a=nan"], "expected RAD or ANTENNA=RAD"),
                        (["--offset", "b=1"], "no reads of antenna 'b' (did you mean 'a'?)"),
                        (["--pose-sigma", "-1"], "--pose-sigma"),
                        (["--pose-sigma", "nan"], "pose"),
                        (["--pose-yaw-sigma", "1"], "--pose-sigma"),
                        (["--pose-sigma", "1", "--pose-time-constant", "0"], "time-constant"),
                        (["--reference", "twice.csv"], "twice.csv:3: tag 'one' is listed twice"),
                        (["--reference", "absent.csv"], "no such file")):
        result = context.run("localize", "reads.csv", "--poses", "poses.csv", *words)
        check_equal(result.code, 2, f"{words}: exit code")
        check_equal(len(result.err.splitlines()), 1, f"{words}: lines of {result.err!r}")
        check_in(says, result.err, str(words))


# --- Imperfect reads ------------------------------------------------------------------------------

@case
def clocks_that_differ(context):
    """One antenna's reads have stamps since 1970, its poses since the start; the other is consistent."""
    reads = (read_rows({"one": TAGS["one"], "two": TAGS["two"]}) +
             read_rows({"lost": TAGS["three"]}, antenna="b", shift=1.7e9))
    poses = pose_rows() + pose_rows("b")
    for method in METHODS:
        result, estimates, summary = localize(context, reads, poses, "--method", method)
        check_located(estimates, ("one", "two"), method, 0.05)
        check_hopeless(estimates, "lost", "no reads that have an antenna pose", method)
        warnings = [line for line in summary["warnings"] if "apart" in line]
        check_equal(len(warnings), 1, f"{method}: warnings of clocks in {summary['warnings']}")
        for part in ("antenna 'b': 360 of 360 reads", "reads are from 1700000000.000 to ",
                     "poses from 0.000 to 24.000 s", "1699999976.000 s apart"):
            check_in(part, result.err, f"{method}: the warning")


@case
def poses_that_do_not_cover_the_reads(context):
    for method in METHODS:
        result, estimates, _ = localize(context, read_rows(TAGS), pose_rows(begin=4.0, end=18.0),
                                        "--method", method)
        check_located(estimates, TAGS, method, 0.05)
        check_in("reads are from 0.000 to 23.933 s, poses from 4.000 to 18.000 s", result.err,
                 f"{method}: the warning")
    hole = pose_rows(end=10.0) + pose_rows(begin=14.0)
    result, estimates, _ = localize(context, read_rows(TAGS), hole, "--method", "ml")
    check_located(estimates, TAGS, "ml with a hole")
    check_in("its poses there are over 0.5 s apart", result.err, "the warning of a hole")
    result, estimates, _ = localize(context, read_rows(TAGS), pose_rows("mast"))
    check_hopeless(estimates, "one", "no reads that have an antenna pose", "other names")
    check_in("there are no poses of it (known: mast)", result.err, "the warning of other names")


@case
def rows_out_of_order_and_twice(context):
    reads, poses = read_rows(TAGS), pose_rows()
    shuffled, jumbled = list(reads), list(poses)
    random.Random(1).shuffle(shuffled)
    random.Random(2).shuffle(jumbled)
    for method in METHODS:
        _, expected, _ = localize(context, reads, poses, "--method", method)
        result, estimates, _ = localize(context, shuffled, jumbled, "--method", method)
        check_equal(estimates, expected, f"{method}: estimates of shuffled rows")
        for name in ("reads.csv", "poses.csv"):
            check_in(f"{name}: ", result.err, f"{method}: the warnings")
        check_in("they are sorted by time", result.err, f"{method}: the warnings")
        result, estimates, _ = localize(context, reads + reads[:90], poses, "--method", method)
        check_equal({tag: position(row) for tag, row in estimates.items()},
                    {tag: position(row) for tag, row in expected.items()},
                    f"{method}: estimates with repeated rows")
        check_in("antenna 'a': 90 of 1170 reads repeat tag and stamp of another", result.err,
                 f"{method}: the warnings")
    result, _, _ = localize(context, reads, poses + poses[:7])
    check_in("antenna 'a': 7 poses repeat the stamp of another", result.err, "the warnings")


def stamped(rows, stamp_of):
    """The rows with stamps [s] changed by a function."""
    return [f"{stamp_of(float(stamp)):.6f},{rest}"
            for stamp, rest in (row.split(",", 1) for row in rows)]


def check_memory(what):
    """Checks the peak memory of all programs so far; these tables need 25 MB, sanitizers more."""
    if "TAGFIELD_SANITIZED" in os.environ:
        return
    most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    check(most < 500, f"{what}: {most:.0f} MB of memory")


@case
def one_row_with_a_wrong_clock(context):
    """A stamp near 1970 among present ones, or the reverse: at most that row is lost."""
    for clock, wrong in ((1.7e9, 0.0), (0.0, 1.7e9)):
        reads, poses = read_rows(TAGS, shift=clock), pose_rows(shift=clock)
        bad_reads = reads[:500] + stamped(reads[500:501], lambda _: wrong) + reads[501:]
        bad_poses = poses[:160] + stamped(poses[160:161], lambda _: wrong) + poses[161:]
        for method in METHODS:
            _, expected, _ = localize(context, reads, poses, "--method", method)
            for names, rows in ((("reads.csv",), (bad_reads, poses)),
                                (("poses.csv",), (reads, bad_poses)),
                                (("reads.csv", "poses.csv"), (bad_reads, bad_poses))):
                what = f"{method} with clock {clock:g} but {wrong:g} in {names}"
                result, estimates, _ = localize(context, *rows, "--method", method)
                check_memory(what)
                check_located(estimates, TAGS, what, 0.05)
                for tag, row in estimates.items():
                    check_near(math.dist(position(row), position(expected[tag])), 0.0,
                               float(expected[tag]["expected_error_m"]), f"{what}: shift of {tag}")
                for name in names:
                    check_in(f"antenna 'a': 1 {name[:5]} left out, at {wrong:.9f} s, far from all "
                             "others", result.err, what)


@case
def pauses(context):
    """Pauses of a day or a year in the middle, and forty pauses of an hour."""
    def pauses_of(count, seconds):
        return lambda stamp: stamp + seconds * math.floor(stamp / 24.1 * (count + 1))
    reads, poses = read_rows(TAGS), pose_rows(error=lambda t: (0.01 * math.sin(t / 3), 0.0))
    for sigma in ((), ("--pose-sigma", "0.01")):
        for method in METHODS:
            _, expected, without = localize(context, reads, poses, "--method", method, *sigma)
            # Only for poses without a stated error, and methods that do not estimate it.
            said = ["as exact" in warning for warning in without["warnings"]]
            check_equal(said, [] if sigma or method in ("auto", "joint") else [True], f"{method}: warnings {without['warnings']}")
            for count, seconds in ((1, 86400), (1, 365 * 86400), (40, 3600)):
                what = f"{method} with {count} pauses of {seconds} s"
                shift = pauses_of(count, seconds)
                _, estimates, summary = localize(context, stamped(reads, shift),
                                                 stamped(poses, shift), "--method", method, *sigma)
                check_memory(what)
                check_located(estimates, TAGS, what, 0.05)
                check_equal(summary["warnings"], without["warnings"], f"{what}: warnings")
                for tag, row in estimates.items():
                    check_near(math.dist(position(row), position(expected[tag])), 0.0,
                               2 * float(expected[tag]["expected_error_m"]),
                               f"{what}: shift of {tag}")


@case
def stamps_that_are_no_time(context):
    """Stamps beyond 146 years from 0, whose differences could overflow."""
    for shift in (9.1e9, -9.1e9):
        for name in ("reads.csv", "poses.csv"):
            reads, poses = read_rows(TAGS), pose_rows()
            rows = reads if name == "reads.csv" else poses
            rows[3] = stamped(rows[3:4], lambda stamp: stamp + shift)[0]
            context.write("reads.csv", "\n".join(
                ["stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm", *reads]) + "\n")
            context.write("poses.csv", "\n".join(
                ["stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw", *poses]) + "\n")
            result = context.run("localize", "reads.csv", "--poses", "poses.csv")
            check_equal(result.code, 2, f"exit code for {shift:g} in {name}")
            check_in(f"{name}:5: stamp_s: stamp ", result.err, "the complaint")
            check_in("expected less than 4.6e+09 s (146 years) from 0", result.err, "the complaint")


@case
def several_carriers(context):
    """A reader that changes its channel every two seconds."""
    channels = (865.7e6, 866.3e6, 866.9e6, 867.5e6)
    reads = read_rows(TAGS, carrier=lambda i: channels[i // 30 % 4])
    for method in METHODS:
        result, estimates, summary = localize(context, reads, pose_rows(), "--method", method,
                                              "--pose-sigma", "0")
        check_in("on 4 carriers from 865.7 to 867.5 MHz", result.out, "what is printed")
        check_located(estimates, TAGS, method, 0.05)
        check_equal(summary["warnings"], [], f"{method}: warnings")
    in_megahertz = [row.replace("865700000", "865.7") if i % 200 == 0 else row
                    for i, row in enumerate(read_rows(TAGS))]
    for method in METHODS:
        result, estimates, _ = localize(context, in_megahertz, pose_rows(), "--method", method,
                                        "--pose-sigma", "0")
        check_in("6 of 1080 reads have no usable phase or carrier", result.err, method)
        check_in("frequency_hz goes from 865.7 to 8.657e+08: is all of it in Hz?", result.err,
                 f"{method}: the warning")
        check_located(estimates, ("one", "two"), method)


@case
def tags_with_hardly_a_read(context):
    reads = read_rows(TAGS)
    once = read_rows({"once": TAGS["one"]})[40:41]
    thrice = read_rows({"thrice": TAGS["one"]})[40:43]
    for method in METHODS:
        _, estimates, _ = localize(context, reads + once + thrice, pose_rows(), "--method", method)
        check_located(estimates, TAGS, method, 0.05)
        check_hopeless(estimates, "once", "only 1 read", method)
        check_hopeless(estimates, "thrice", "only 3 reads", method)
        _, estimates, _ = localize(context, once, pose_rows(), "--method", method)
        check_hopeless(estimates, "once", "only 1 read", method)


@case
def bad_numbers_name_file_and_line(context):
    for column, bad in ((0, "nan"), (0, ""), (4, "inf"), (4, ""), (4, "0"), (5, "nan"), (5, "inf"),
                        (5, ""), (6, "-inf")):
        rows = read_rows({"one": TAGS["one"]})
        fields = rows[7].split(",")
        fields[column] = bad
        rows[7] = ",".join(fields)
        context.write("reads.csv", "\n".join(
            ["stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm", *rows]) + "\n")
        context.write("poses.csv", "\n".join(
            ["stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw", *pose_rows()]) + "\n")
        result = context.run("localize", "reads.csv", "--poses", "poses.csv", "--out", "bad")
        check_equal(result.code, 2, f"column {column} {bad!r}: exit code")
        check_in("reads.csv:9: ", result.err, f"column {column} {bad!r}")
        check(not (context.folder / "bad").exists() or not any((context.folder / "bad").iterdir()),
              "something was written")


# --- Third-party tables ---------------------------------------------------------------------------

def adarf_folder(context, tags):
    """A folder of tables like AdaRF's experiments: 50 stops of 2 cm, 8 channels, a byte order mark, no
    clock. Each tag has a second propagation path."""
    noise = random.Random(9)
    offsets = [noise.uniform(0, 2 * math.pi) for _ in range(8)]
    for stop in range(50):
        rows = ["epc,antennaIndex,frequency,time,RSSI,phase,dopplerShift,velocity,x,y,z,angle"]
        x = 0.02 * stop
        for tag, (at, away) in tags.items():
            for channel, offset in enumerate(offsets):
                carrier = 920.625e6 + 0.5e6 * channel
                k = 2 * math.pi * carrier / SPEED_OF_LIGHT
                direct = math.hypot(at - x, away)
                echo = math.hypot(at + 0.4 - x, away + 0.5)
                field = (cmath.rect(1 / direct, k * direct) + cmath.rect(0.3 / echo, k * echo))**2
                for _ in range(3):
                    phase = (cmath.phase(field) + offset + noise.gauss(0, 0.03)) % (2 * math.pi)
                    rssi = -45 + 20 * math.log10(abs(field))
                    rows.append(f"{tag},1,{carrier:.0f},0,{rssi:.1f},{phase:.6f},0,0,{x},1.63,0,0")
        context.write(f"scan/{stop}.csv", "\ufeff" + "\n".join(rows) + "\n")


def require_archives(context):
    """Skips the case in builds without libarchive."""
    if "built without libarchive" in context.run("localize", "none.tar", "--format", "adarf").err:
        raise Skip("this tagfield was built without libarchive (libarchive-dev)")


RAIL_TAGS = {"a1": (0.3, 0.6), "b2": (0.5, 0.6), "c3": (0.7, 0.6)}


@case
def a_folder_of_stops_amid_echoes(context):
    adarf_folder(context, RAIL_TAGS)
    result = context.run_well("localize", "scan", "--format", "adarf", "--side=+y", "--out", "out")
    check_in("method: scan", result.out, "what was chosen")
    rows = {row["tag"]: row for row in read_csv(context.folder / "out/estimates.csv")}
    for tag, (x, away) in RAIL_TAGS.items():
        if check_equal(rows[tag]["verdict"], "located", f"verdict on {tag} ({rows[tag]['reason']})"):
            error = math.dist((x, 1.63 + away), position(rows[tag])[:2])
            check(error < 0.12, f"{tag}: {error:.3f} m off")
            check(error < 5 * float(rows[tag]["expected_error_m"]), f"{tag}: expected too little")


@case
def a_folder_of_stops_in_an_archive(context):
    require_archives(context)
    adarf_folder(context, RAIL_TAGS)
    for name in ("scan.tar", "scan.tar.gz", "scan.tar.xz"):
        with tarfile.open(context.folder / name, f"w:{name[9:]}") as archive:
            archive.add(context.folder / "scan", "dataset/1/scan")
    how = ("--format", "adarf", "--side=+y", "--method", "sar")
    context.run_well("localize", "scan", *how, "--out", "plain")
    plain = (context.folder / "plain/estimates.csv").read_bytes()
    described = [json.loads(context.run_well("check", name, "--format", "adarf", "--json").out)
                 for name in ("scan", "scan.tar.gz")]
    check_equal(described[1]["reads"], read_json(context.folder / "plain/summary.json")["reads"], "reads by check")
    for facts in described:
        facts.pop("warnings")
    check_equal(described[0], described[1], "check of the folder and of the archive")
    for name in ("scan.tar", "scan.tar.gz", "scan.tar.xz"):
        context.run_well("localize", name, *how, "--out", name + "_out")
        check((context.folder / f"{name}_out/estimates.csv").read_bytes() == plain,
              f"{name} gives other estimates than the folder that it holds")
    stop = context.folder / "scan/17.csv"
    context.write("scan/17.csv", stop.read_text(encoding="utf-8").replace("a1,1,9", "a1,1,x", 1))
    with tarfile.open(context.folder / "bad.tar", "w") as archive:
        archive.add(context.folder / "scan", "scan")
    result = context.run("localize", "bad.tar", *how, "--out", "bad")
    check_equal(result.code, 2, "exit code on a bad table in an archive")
    check_in("tagfield: bad.tar/scan/17.csv:2: ", result.err, "the complaint")
    check(not (context.folder / "bad").exists(), "a folder is left behind")


@case
def archives_that_lead_elsewhere_are_refused(context):
    require_archives(context)
    context.write("t.csv", "x\n1\n")
    with tarfile.open(context.folder / "up.tar", "w") as archive:
        archive.add(context.folder / "t.csv", "../up.csv")
    link = tarfile.TarInfo("scan")
    link.type, link.linkname = tarfile.SYMTYPE, str(context.folder)
    with tarfile.open(context.folder / "link.tar", "w") as archive:
        archive.addfile(link)
        archive.add(context.folder / "t.csv", "scan/up.csv")
    context.write("cut.csv.gz", b"\x1f\x8b\x08\x00cut")
    for name, says in (("up.tar", "'../up.csv', which leads out of it"),
                       ("link.tar", "holds the link 'scan'"), ("cut.csv.gz", "can't be unpacked"),
                       ("none.tar.zst", "can't be unpacked")):
        result = context.run("localize", name, "--format", "adarf", "--out", "out")
        check_equal((result.code, result.out), (2, ""), f"exit code and stdout on {name}")
        check_equal(len(result.err.splitlines()), 1, f"lines on {name}")
        check_in(f"tagfield: {name}: ", result.err, "the complaint")
        check_in(says, result.err, "the complaint")
    check(not list(context.folder.rglob("up.csv")), "a file got out of an archive")


@case
def sides_and_boxes_choose_between_mirror_images(context):
    adarf_folder(context, RAIL_TAGS)
    both = ("localize", "scan", "--format", "adarf", "--out", "out")
    for more, verdict in (((), "ambiguous"), (("--side", "left"), "located"),
                          (("--side=-y",), "located"),
                          (("--box", "0", "1.7", "1", "3"), "located"),
                          (("--box", "0,1.7,1,3"), "located"),
                          (("--side", "left", "--set", "max_error_m=0.0001"), "not_located"),
                          (("--side", "left", "--set", "localization.max_error_m=0.0001"), "not_located"),
                          (("--box", "5", "5", "6", "6"), "not_located")):
        context.run_well(*both, *more)
        rows = read_csv(context.folder / "out/estimates.csv")
        check_equal({row["verdict"] for row in rows}, {verdict}, f"verdicts with {more}")
        if verdict == "located":
            sign = 1 if float(rows[0]["y_m"]) > 1.63 else -1
            check_equal(sign, -1 if "--side=-y" in more else 1, f"side with {more}")


def turned(rows):
    """Reads of a wire at 45° along the path by a right-circular antenna with its boresight along y."""
    more = []
    for row in rows:
        values = row.split(",")
        x, y, z = path(float(values[0]))
        way = [a - b for a, b in zip(FARTHER[values[3]], (x, y, z))]
        u = [a / math.hypot(*way) for a in way]
        wire = (0.5 ** 0.5, 0, 0.5 ** 0.5)
        along = sum(a * b for a, b in zip(u, wire))
        across = [w - along * a for w, a in zip(wire, u)]
        # Left of the boresight is −x, as it points along y.
        turn = -2 * math.atan2(-across[0], across[2])
        values[5] = f"{(float(values[5]) + turn) % (2 * math.pi):.6f}"
        more.append(",".join(values))
    return more


FARTHER = {"t": (3.0, 1.8, HEIGHT + 0.7)}


@case
def circular_antennas_turn_phases_by_the_wire(context):
    looking = [row.replace(",0,0,0,1", ",0,0,0.7071067811865476,0.7071067811865476") for row in pose_rows()]
    height = ("--method", "ml", "--pose-sigma", "0", "--tag-height", str(FARTHER["t"][2]))
    off = {}
    for words in ((), ("--circular", "right")):
        _, estimates, _ = localize(context, turned(read_rows(FARTHER)), looking, *height, *words)
        off[words] = math.dist((float(estimates["t"]["x_m"]), float(estimates["t"]["y_m"])), FARTHER["t"][:2])
        expected = float(estimates["t"]["expected_error_m"])
    check(off["--circular", "right"] < 3 * expected and off["--circular", "right"] < 0.5 * off[()],
          f"errors {off}, {expected} expected with --circular")
    result, _, _ = localize(context, read_rows(FARTHER), pose_rows(), *height, "--circular", "left")
    check("--circular has no effect" in result.err, f"no warning of poses without orientation: {result.err}")


@case
def options_that_a_method_does_not_use_are_warned_of(context):
    height = ("--tag-height", str(HEIGHT))
    for method, words, warned in (("trilateration", ("--pose-sigma", "0.02"), "--pose-sigma has no effect with trilateration"),
                                  ("hyperbola", ("--offset", "1"), "--offset has no effect with hyperbola"),
                                  ("ml", ("--offset", "1", "--pose-sigma", "0.02"), None)):
        result, _, _ = localize(context, read_rows(FARTHER), pose_rows(), *height, "--method", method, *words)
        check_equal("has no effect" in result.err, warned is not None, f"{method}: {result.err}")
        check_in(warned or "", result.err, method)


@case
def formats_by_name_in_track_and_calibrate(context):
    adarf_folder(context, RAIL_TAGS)
    context.write("tags.csv", "tag,x_m,y_m,z_m\n" + "".join(
        f"{tag},{x},{1.63 + away},0\n" for tag, (x, away) in RAIL_TAGS.items()))
    context.run_well("calibrate", "scan", "--format", "adarf", "--tags", "tags.csv", "--out",
                     "profile.yaml")
    check((context.folder / "profile.yaml").exists(), "no profile was written")
    context.run_well("track", "scan", "--format", "adarf", "--out", "tracked")
    check_equal(len(read_csv(context.folder / "tracked/verdicts.csv")), 3, "tags tracked or not")
    result = context.run("localize", "scan", "--format", "adraf", "--out", "out")
    check_equal(result.code, 2, "exit code on an unknown format")
    check_in("did you mean 'adarf'", result.err, "the complaint")


@case
def the_folder_of_a_run_is_its_tables(context):
    run = context.folder / "run"
    context.run_well("run", context.source / "scenarios/paper_warehouse.yaml", "--record-only", "--out", run)
    context.run_well("localize", run, "--method", "ml", "--tag-height", 1.5, "--out", context.folder / "folder")
    context.run_well("localize", run / "reads.csv", "--poses", run / "antenna_poses.csv", "--method", "ml",
                     "--tag-height", 1.5, "--out", context.folder / "tables")
    check_equal(*((context.folder / name / "estimates.csv").read_text(encoding="utf-8")
                  for name in ("folder", "tables")), "estimates")


@case
def the_folder_of_a_run_by_wheels_states_their_drift(context):
    run = context.simulate("paper_warehouse", "--set", "pose.source=odometry", "--set", "pose.wheel_noise=0.002",
                           "--set", "localization.method=joint", "--seed", "4", "--no-page")
    ours = {row["tag"]: row for row in read_csv(run / "estimates.csv")}
    result = context.run_well("localize", run, "--method", "joint", "--out", "new")
    check_in(f"{run}/odometry.csv", result.out, "what was used")
    check_equal(result.err, "", "stderr")
    check_equal(read_csv(context.folder / "new/odometry.csv"), read_csv(run / "odometry.csv"), "odometry.csv")
    # The tables round phases to six decimals.
    for row in read_csv(context.folder / "new/estimates.csv"):
        for column in ("x_m", "y_m", "expected_error_m"):
            check_near(float(row[column]), float(ours[row["tag"]][column]), 1e-4, f"{row['tag']} {column}")
    # So they do beside a scenario that says otherwise, and with the table alone.
    context.run_well("localize", run, "--method", "joint", "--scenario", context.shipped("paper_warehouse"),
                     "--out", "beside")
    tables = ["localize", run / "reads.csv", "--poses", run / "antenna_poses.csv", "--tag-heights",
              run / "tag_heights.csv", "--method", "joint"]
    context.run_well(*tables, "--odometry", run / "odometry.csv", "--out", "tables")
    for name in ("beside", "tables"):
        for row in read_csv(context.folder / name / "estimates.csv"):
            check_near(float(row["expected_error_m"]), float(ours[row["tag"]]["expected_error_m"]), 1e-4,
                       f"{name} {row['tag']}")
    # A folder that states no more than that it was odometry is warned of.
    (run / "odometry.csv").unlink()
    result = context.run_well("localize", run, "--method", "joint", "--out", "old")
    check_in("the poses are wheel odometry", result.err, "without odometry.csv")


@case
def jumps_of_the_poses_are_warned_of(context):
    run = context.simulate("paper_warehouse", "--no-page")
    rows = read_csv(run / "antenna_poses.csv")
    lines = [",".join(rows[0])]
    for row in rows:
        if float(row["stamp_s"]) > 20:
            row["x_m"] = str(float(row["x_m"]) + 0.3)
        lines.append(",".join(row.values()))
    poses = context.write("jumped.csv", "\n".join(lines) + "\n")
    for command in (["localize", "--tag-height", "1.5", "--out", "moved"], ["check"]):
        arguments = [command[0], run / "reads.csv", "--poses", poses, *command[1:]]
        result = context.run_well(*arguments)
        check_in("the poses of antenna 'mobile' jump by 0.30 m, from 20.0", result.out + result.err, command[0])
        check("good" not in result.out, f"{command[0]} says {result.out!r}")
        if command[0] == "localize":
            reasons = [row["reason"] for row in read_csv(context.folder / "moved/estimates.csv")]
            check(any("a jump of the poses leaves it uncertain by 0." in reason for reason in reasons), f"{reasons}")
        smooth = context.run_well(*arguments[:3], run / "antenna_poses.csv", *command[1:])
        check("jump by" not in smooth.out + smooth.err, f"{command[0]} of the poses as they are: {smooth.err!r}")


@case
def the_folder_of_a_run_states_heights_and_truth(context):
    run = context.folder / "run"
    context.run_well("run", context.shipped("paper_warehouse"), "--no-page", "--out", run)
    ours = read_json(run / "summary.json")
    result = context.run_well("localize", run, "--method", "hyperbola", "--out", "new")
    check("heights" not in result.err, f"stderr: {result.err!r}")
    check_in(f"known beforehand: {run}/tag_heights.csv\njudged by: {run}/truth\n", result.out, "what was used")
    new = read_json(context.folder / "new/summary.json")
    check_equal(new["located"], ours["located"], "located")
    check_near(new["error_m"]["mean"], ours["error_m"]["mean"], 1e-7, "mean error")  # Tables round phases.
    check_near(new["path_length_m"], ours["path_length_m"], 0.02, "path")
    for name in ("tag_heights.csv", "truth/tags.csv", "truth/distances.csv", "truth/robot_poses.csv"):
        check_equal((context.folder / "new" / name).read_bytes(), (run / name).read_bytes(), name)
    # Options take precedence, and the table alone knows nothing.
    result = context.run_well("localize", run, "--tag-height", "1.5", "--out", "other")
    check("known beforehand" not in result.out, f"with --tag-height: {result.out!r}")
    check_equal({float(row["z_m"]) for row in read_csv(context.folder / "other/estimates.csv") if row["z_m"]}, {1.5},
                "heights with --tag-height")
    result = context.run_well("localize", run / "reads.csv", "--poses", run / "antenna_poses.csv", "--out", "table")
    check_in("the tags' heights are not stated", result.err, "the table alone")
    check("judged by" not in result.out, f"the table alone: {result.out!r}")
    # In place, nothing of the run is lost.
    before = {name for name in files_in(run) if not name.startswith(("report", "figures"))}
    context.run_well("localize", run, "--method", "ml", "--out", run)
    lost = before - set(files_in(run))
    check_equal(lost, set(), "files lost in place")
    check_equal(read_json(run / "summary.json")["method"], "ml", "method in place")


@case
def tags_that_were_never_read_are_named_once(context):
    context.write("known.csv", "tag,x_m,y_m,z_m\none,2,2.5,1\n" + "".join(f"t{i},0,{i},1\n" for i in range(5)))
    context.write("heights.csv", f"tag,height_m\ntwoo,{HEIGHT}\none,{HEIGHT}\n")
    words = ("--reference", "known.csv", "--tag-heights", "heights.csv", "--method", "ml", "--pose-sigma", "0")
    for more in ((), ("--part-reads", "400")):
        result, _, _ = localize(context, read_rows(TAGS), pose_rows(), *words, *more)
        said = [line for line in result.err.splitlines() if "never read" in line]
        check_equal(len(said), 2, f"warnings {more}: {result.err!r}")
        check_in("known.csv: --reference: 5 of 6 tags were never read, 't0', 't1', 't2' and so on", said[0], "references")
        check_in("heights.csv: --tag-heights: 1 of 2 tags were never read, 'twoo' (did you mean 'two'?)", said[1],
                 "heights")


@case
def check_warns_as_localize_does(context):
    _, _, summary = localize(context, read_rows(TAGS), pose_rows(), "--pose-sigma", "0")
    check_near(summary["simulated_s"], 359 / 15, 1e-6, "time from the first read to the last")
    both = ("reads.csv", "--poses", "poses.csv")
    good = context.run_well("check", *both)
    check_equal((good.out.splitlines()[0], good.err), ("reads.csv: good", ""), "good tables")
    header = "stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm"

    def table(name, column, change):
        rows = [row.split(",") for row in read_rows(TAGS)]
        for row in rows:
            row[column] = f"{change(float(row[column])):.6f}"
        context.write(name, "\n".join([header, *(",".join(row) for row in rows)]) + "\n")
        return name

    for name, says in (
            (table("mhz.csv", 4, lambda hertz: hertz / 1e6), ("mhz.csv:2: frequency_hz is 865.7, expected a carrier in "
             "Hz, from 1e+06 to 1e+11: is it in MHz?", "have no usable phase or carrier")),
            (table("degrees.csv", 5, math.degrees), ("phase_rad is ", "but not for degrees")),
            (table("cycles.csv", 5, lambda rad: rad / 2 / math.pi), ("they can't be in radians",)),
            (table("ms.csv", 0, lambda seconds: 1e3 * seconds), ("have no pose at their stamp",))):
        checked = context.run_well("check", name, "--poses", "poses.csv")
        located = context.run_well("localize", name, "--poses", "poses.csv", "--pose-sigma", "0", "--out", "odd")
        for words in says:
            check_in(words, checked.err, f"check {name}")
            check_in(words, located.err, f"localize {name}")
        check_in(f"{name}: can be read, with ", checked.out, "check")
    # Without poses, the reads alone.
    check_in("is it in MHz?", context.run_well("check", "mhz.csv").err, "check without poses")
    result = context.run("check", "poses.csv", "--poses", "poses.csv")
    check_equal(result.code, 2, "poses of poses")
    check_in("--poses is for tables of reads", result.err, "poses of poses")


@case
def archives_need_their_format(context):
    require_archives(context)
    for name in ("one", "two"):
        context.write(f"scan/{name}.csv", "epc,x\n")
    with tarfile.open(context.folder / "two.tgz", "w:gz") as archive:
        archive.add(context.folder / "scan", "scan")
    for command in (("localize", "two.tgz"), ("localize", "two.tgz", "--poses", "p.csv"), ("check", "two.tgz")):
        result = context.run(*command)
        check_equal((result.code, len(result.err.splitlines())), (2, 1), f"{command}: {result.err!r}")
        check_in("two.tgz/scan: has 2 tables (one.csv, two.csv), but not the reads.csv of a run, and therefore needs "
                 "--format: adarf, ", result.err, f"{command}")
    # A run in an archive needs none.
    run = context.simulate("z_axis", "--record-only")
    with tarfile.open(context.folder / "run.tar", "w") as archive:
        for name in ("reads.csv", "antenna_poses.csv"):
            archive.add(run / name, name)
    described = json.loads(context.run_well("check", "run.tar", "--json").out)
    check_equal(described["reads"], len(read_csv(run / "reads.csv")), "reads in the archive")


@case
def reads_that_do_not_fit_in_memory(context):
    """In parts on disk: identical estimates for methods that locate tags one by one, and no leftovers."""
    context.write("known.csv", "tag,x_m,y_m,z_m\none,2,2.5,1\n")
    reads = read_rows(TAGS)
    for method in ("hyperbola", "ml", "sar"):
        known = ("--method", method, "--reference", "known.csv", "--pose-sigma", "0")
        _, expected, _ = localize(context, reads, pose_rows(), *known)
        whole = (context.folder / "out/report.html").read_bytes()
        _, estimates, summary = localize(context, reads, pose_rows(), *known, "--part-reads",
                                         str(len(reads) // 3))
        check_equal(estimates, expected, f"{method}: estimates in parts")
        check_equal(summary["reads"], len(reads), "reads")
        check_equal((context.folder / "out/report.html").read_bytes(), whole, f"{method}: page")
        check_equal((context.folder / "out/reads.csv").read_bytes(), (context.folder / "reads.csv").read_bytes(),
                    "the table as it was")
    # For a tag with more reads than a part, only every second read is used.
    result, estimates, _ = localize(context, reads, pose_rows(), "--part-reads", "200", "--method", "ml")
    check_located(estimates, TAGS, "every second read")
    check_in("3 tags have over 200 reads, up to 360: only every second", result.err, "warning")
    check_equal({row["reads"] for row in estimates.values()}, {"180"}, "reads that count")
    check_equal(sorted(path.name for path in context.folder.iterdir()),
                ["known.csv", "out", "poses.csv", "reads.csv"], "files")
    bad = reads[:700] + ["1,r,a,one,865700000,x,-50"] + reads[700:]
    context.write("bad.csv", "\n".join(["stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm", *bad]) + "\n")
    for arguments, words in ((("bad.csv", "--poses", "poses.csv"), "bad.csv:702: phase_rad is 'x'"),
                             (("reads.csv", "--poses", "poses.csv", "--format", "adarf"),
                              "can only be used with CSV in Tagfield's")):
        result = context.run("localize", *arguments, "--part-reads", "100", "--out", "new")
        check_equal(result.code, 2, f"{arguments}: exit code")
        check_in(words, result.err, "what it says")
        check(not (context.folder / "new").exists(), f"{arguments}: results")
    os.mkfifo(context.folder / "pipe")
    result = context.run("localize", "pipe", "--poses", "poses.csv", "--part-reads", "100",
                         "--out", "new")
    check_equal(result.code, 2, "exit code with a pipe")
    check_in("pipe: can't be read twice", result.err, "what it says")


@case
def reads_that_are_not_kept(context):
    """A table of over 100 MB is read again each time: identical results, and the table is unchanged."""
    reads = read_rows(TAGS)
    words = ("--method", "joint")
    _, expected, _ = localize(context, reads, pose_rows(), *words)
    zeros = "0" * (100_000_000 // len(reads))
    rows = [row.split(",") for row in reads]
    long = [",".join([*row[:5], (row[5] if "." in row[5] else row[5] + ".") + zeros, row[6]]) for row in rows]
    result, estimates, summary = localize(context, long, pose_rows(), *words)
    check_equal(estimates, expected, "estimates")
    check_equal(summary["reads"], len(reads), "reads")
    table = context.folder / "reads.csv"
    check(table.stat().st_size > 100_000_000, "the table is too small for this test")
    check(filecmp.cmp(context.folder / "out/reads.csv", table, shallow=False), "the copy differs from the table")
    check((context.folder / "out/report.html").stat().st_size < 5_000_000, "the page holds all of the table")


@case
def a_known_world_and_how_well(context):
    """The world of a run is known exactly; for tables to a centimetre, or as stated on the command line."""
    scenario = context.shipped("warehouse_physics")
    run = context.simulate("warehouse_physics", "--record-only", "--set", "duration_s=40")
    lines = (run / "reads.csv").read_text(encoding="utf-8").splitlines()
    tag = lines[0].split(",").index("tag")
    few = [line for line in lines[1:] if line.split(",")[tag] in ("tag2", "tag3", "tag8")]
    (run / "reads.csv").write_text("\n".join([lines[0], *few]) + "\n", encoding="utf-8")
    tables = (run / "reads.csv", "--poses", run / "antenna_poses.csv")

    def located(name, *arguments):
        folder = context.folder / name
        context.run_well("localize", *arguments, "--scenario", scenario, "--method", "multipath", "--out", folder)
        return {row["tag"]: row for row in read_csv(folder / "estimates.csv") if row["verdict"] == "located"}

    of_run, of_tables = located("of_run", run), located("of_tables", *tables)
    given = located("given", *tables, "--world-sigma", "0.002")
    check(len(of_run) >= 2, f"only {len(of_run)} of three tags are located")
    check_equal(set(of_run), set(given), "tags that are located")
    for tag, row in of_run.items():
        for rows, sigma_m in ((of_tables, 0.01), (given, 0.002)):
            if tag not in rows:
                continue
            for entry in ("cov_xx", "cov_yy"):
                check_near(float(rows[tag][entry]) - float(row[entry]), (2 * sigma_m) ** 2, 1e-8, f"{tag}: {entry}")

    bad = context.run("localize", *tables, "--scenario", scenario, "--method", "robust", "--world-sigma", "0.01",
                      "--out", context.folder / "bad")
    check_equal(bad.code, 2, "exit code of a setting without an effect")
    check_in("--world-sigma has no effect", bad.err, "what it says")


if __name__ == "__main__":
    main()
