#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every shipped scenario runs with the documented results; the files of a run are consistent."""

import collections
import math
import shutil
import statistics

from bags import RunBag, require_rosbag, write_bag
from common import (SPEED_OF_LIGHT, case, check, check_between, check_equal, check_in, check_near,
                    files_in, main, percentile, position, read_csv, read_json)

POSE_NOISE = ("--set", "pose.source=noisy", "--set", "pose.sigma_m=0.01",
              "--set", "pose.yaw_sigma_deg=0.5")
SUMMARY_KEYS = {"scenario", "description", "seeds", "method", "method_asked", "method_why", "pose",
                "complete", "path_length_m", "reads", "simulated_s", "wall_s", "real_time_factor",
                "pose_error", "compared_pose", "compared_methods", "navigation", "inventory", "effects", "tags",
                "error_m", "over_0_3_m", "located", "ambiguous", "not_located", "warnings"}
TAG_KEYS = {"id", "seed", "verdict", "reason", "truth_m", "moved", "estimate_m", "error_m",
            "rms_m", "expected_error_m", "candidates_m", "candidates_rms_m",
            "candidates_expected_error_m", "reads", "reads_used", "reference"}
RUN_FILES = {"reads.csv", "antenna_poses.csv", "estimates.csv", "summary.json", "report.html",
             "truth/antenna_poses.csv", "truth/robot_poses.csv", "truth/tags.csv",
             "truth/distances.csv"}
# A Pioneer P3-AT is 0.50 m wide and reaches up to about 0.6 m with its laser.
HALF_WIDTH_M = 0.25
ROBOT_BAND_M = (0.1, 0.6)


# --- Geometry -------------------------------------------------------------------------------------

def distance_to_segment(p, a, b):
    along = (b[0] - a[0], b[1] - a[1])
    length2 = along[0] ** 2 + along[1] ** 2
    share = 0.0
    if length2 > 0.0:
        share = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / length2
        share = min(1.0, max(0.0, share))
    return math.hypot(p[0] - a[0] - share * along[0], p[1] - a[1] - share * along[1])


def is_inside(p, rings):
    """Whether a point is inside, by the even-odd rule over all rings."""
    inside = False
    for ring in rings:
        for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
            if (ay > p[1]) != (by > p[1]) and p[0] < ax + (p[1] - ay) * (bx - ax) / (by - ay):
                inside = not inside
    return inside


def clearance(p, rings):
    """Distance from a point to a silhouette; 0 inside it."""
    if is_inside(p, rings):
        return 0.0
    return min(distance_to_segment(p, a, b)
               for ring in rings for a, b in zip(ring, ring[1:] + ring[:1]))


def box_of(ring_points):
    xs, ys = zip(*ring_points)
    return min(xs), min(ys), max(xs), max(ys)


def is_near_box(p, box, margin):
    return (box[0] - margin < p[0] < box[2] + margin) and (box[1] - margin < p[1] < box[3] + margin)


def least_clearance(places, silhouettes, far=1.0):
    """The smallest clearance of any position, and the object; `far` if all are further away."""
    low, high = ROBOT_BAND_M
    least = (far, "nothing")
    for silhouette in silhouettes:
        if silhouette["z_min"] > high or silhouette["z_max"] < low:
            continue
        box = box_of([point for ring in silhouette["rings"] for point in ring])
        for p in places:
            if is_near_box(p, box, least[0]):
                least = min(least, (clearance(p, silhouette["rings"]), silhouette["name"]))
    return least


def path_length(places):
    return sum(math.dist(a, b) for a, b in zip(places, places[1:]))


# --- Files of a run, for any scenario -------------------------------------------------------------

def tags_of(summary):
    return {tag["id"]: tag for tag in summary["tags"]}


def by_antenna(rows):
    found = collections.defaultdict(list)
    for row in rows:
        found[row["antenna"]].append(row)
    return found


def robot_places(folder):
    """The path of each robot, as a list of x, y."""
    places = collections.defaultdict(list)
    for row in read_csv(folder / "truth/robot_poses.csv"):
        places[row["robot"]].append(position(row)[:2])
    return places


def check_clear_path(folder):
    silhouettes = read_json(folder / "top_view.json")
    check(silhouettes, "top_view.json is empty")
    tall = [s for s in silhouettes
            if s["z_max"] >= ROBOT_BAND_M[0] and s["z_min"] <= ROBOT_BAND_M[1]]
    check(tall, "no silhouette stands between 0.1 and 0.6 m: nothing to keep clear of")
    for robot, places in robot_places(folder).items():
        least, name = least_clearance(places, silhouettes)
        check(least >= HALF_WIDTH_M,
              f"robot {robot} passes {name} at {least:.3f} m, expected {HALF_WIDTH_M} m or more")


def check_tag_outcome(tag):
    check_equal(set(tag), TAG_KEYS, f"keys of {tag['id']}")
    located = tag["verdict"] == "located"
    check_equal(tag["estimate_m"] is not None, located, f"{tag['id']} has an estimate")
    check_equal(len(tag["candidates_m"]), len(tag["candidates_rms_m"]), "candidates_rms_m")
    check_equal(len(tag["candidates_m"]), len(tag["candidates_expected_error_m"]),
                "candidates_expected_error_m")
    if located and tag["truth_m"]:
        check_near(tag["error_m"], math.dist(tag["truth_m"], tag["estimate_m"]), 1e-12,
                   f"error_m of {tag['id']}")
    if not located:
        check(tag["reason"], f"{tag['id']} is {tag['verdict']} without a reason")
        check_equal(tag["error_m"], None, f"error_m of {tag['id']}")


def check_statistics(summary):
    errors = [tag["error_m"] for tag in summary["tags"] if tag["error_m"] is not None]
    given = summary["error_m"]
    if errors:
        expected = {"mean": statistics.fmean(errors), "median": statistics.median(errors),
                    "p95": percentile(errors, 0.95), "max": max(errors), "min": min(errors),
                    "count": len(errors)}
        check_equal(set(given), set(expected), "keys of error_m")
        for key, value in expected.items():
            check_near(given[key], value, 1e-12, f"error_m.{key}")
    else:
        check(given is None or given["mean"] is None, f"error_m is {given} without any error")
    check_equal(summary["over_0_3_m"], sum(error > 0.3 for error in errors), "over_0_3_m")
    for verdict in ("located", "ambiguous", "not_located"):
        count = sum(tag["verdict"] == verdict for tag in summary["tags"])
        check_equal(summary[verdict], count, f"summary.{verdict}")


def check_summary(folder, method="hyperbola"):
    """Checks summary.json for consistency with itself and other files, and returns it."""
    summary = read_json(folder / "summary.json")
    check_equal(set(summary), SUMMARY_KEYS, "keys of summary.json")
    for tag in summary["tags"]:
        check_tag_outcome(tag)
    check_statistics(summary)
    check_equal(summary["complete"], True, "complete")
    check_equal(summary["method"], method, "method")
    check_equal(summary["compared_pose"], None, "compared_pose where poses are of one kind")
    check(summary["wall_s"] > 0.0, f"wall_s is {summary['wall_s']}")
    simulated_s = summary["simulated_s"] + (summary["navigation"] or {}).get("mapping_s", 0.0)
    check_near(summary["real_time_factor"] * summary["wall_s"],
               simulated_s * len(summary["seeds"]), 0.15 * simulated_s * len(summary["seeds"]),
               "real_time_factor × wall_s")
    ids = {tag["id"] for tag in summary["tags"]}
    check_equal(len(summary["tags"]), len(ids) * len(summary["seeds"]), "tags × seeds")
    reads = read_csv(folder / "reads.csv")
    check_equal(summary["reads"], len(reads), "reads")
    counts = collections.Counter(row["tag"] for row in reads)
    for tag in summary["tags"]:
        if tag["seed"] == summary["seeds"][0]:
            check_equal(tag["reads"], counts[tag["id"]], f"reads of {tag['id']}")
            least = 0 if method == "none" else 1
            check_between(tag["reads_used"], least, tag["reads"], f"reads used of {tag['id']}")
    return summary


def check_run_folder(folder, method="hyperbola"):
    check(RUN_FILES <= set(files_in(folder)),
          f"the folder lacks {RUN_FILES - set(files_in(folder))}")
    for row in read_csv(folder / "reads.csv"):
        if not (0.0 <= float(row["phase_rad"]) < 2 * math.pi and
                math.isfinite(float(row["rssi_dbm"]))):
            check(False, f"a read holds {row}")
            break
    return check_summary(folder, method)


def check_estimates_csv(folder):
    """Checks that estimates.csv agrees with summary.json."""
    summary = tags_of(read_json(folder / "summary.json"))
    rows = read_csv(folder / "estimates.csv")
    check_equal({row["tag"] for row in rows}, set(summary), "tags in estimates.csv")
    for row in rows:
        check_equal(row["verdict"], summary[row["tag"]]["verdict"], f"verdict of {row['tag']}")
        if row["verdict"] == "located":
            check(math.dist(position(row), summary[row["tag"]]["estimate_m"]) < 2e-6,
                  f"estimates.csv has {row['tag']} elsewhere than summary.json")


# --- The scenarios --------------------------------------------------------------------------------

@case
def paper_warehouse(context):
    folder = context.simulate("paper_warehouse")
    summary = check_run_folder(folder)
    check_estimates_csv(folder)
    check_near(summary["path_length_m"], 22.0, 1.5, "path_length_m")
    check_near(path_length(robot_places(folder)["p3at"]), summary["path_length_m"], 0.1,
               "length of the way in truth/robot_poses.csv")
    check_equal(len(summary["tags"]), 10, "number of tags")
    check_equal(summary["located"], 10, "located")
    check_equal(summary["pose_error"], None, "pose_error with the true pose")
    check_equal((folder / "antenna_poses.csv").read_bytes(),
                (folder / "truth/antenna_poses.csv").read_bytes(), "believed poses")
    check_clear_path(folder)


@case
def paper_warehouse_over_100_seeds(context):
    summary = check_summary(context.simulate("paper_warehouse", "--seeds", "100"))
    check_equal(summary["seeds"], list(range(1, 101)), "seeds")
    check_equal(summary["located"], 1000, "located, of 1000,")
    check_between(summary["error_m"]["mean"], 0.0, 0.015, "mean error")
    check_between(summary["error_m"]["p95"], 0.0, 0.050, "p95 error")
    check_equal(summary["over_0_3_m"], 0, "over_0_3_m")


@case
def paper_warehouse_with_pose_error(context):
    folder = context.simulate("paper_warehouse", "--seeds", "20", *POSE_NOISE)
    summary = check_summary(folder)
    check_equal(summary["pose"], "noisy", "pose")
    check_between(summary["error_m"]["mean"], 0.030, 0.070, "mean error")
    pose = summary["pose_error"]
    check_near(pose["sigma_m"], 0.01, 1e-12, "pose_error.sigma_m")
    check_near(pose["yaw_sigma_rad"], math.radians(0.5), 1e-12, "pose_error.yaw_sigma_rad")
    with_truth = pose["error_with_true_pose_m"]
    check_between(with_truth["mean"], 0.0, 0.015, "mean error with the true pose")
    check_equal(with_truth["count"], 200, "located with the true pose")
    offsets = [math.dist(position(believed)[:2], position(true)[:2]) for believed, true in
               zip(read_csv(folder / "antenna_poses.csv"),
                   read_csv(folder / "truth/antenna_poses.csv"), strict=True)]
    check_near(pose["position_rms_m"], math.sqrt(statistics.fmean(d * d for d in offsets)), 1e-5,
               "position_rms_m")
    page = (folder / "report.html").read_text(encoding="utf-8")
    for phrase in (f"The robot believed its antenna {1e3 * pose['position_rms_m']:.0f} mm (rms) off"
                   " its true position.",
                   f"With the true pose the same reads give {1e3 * with_truth['mean']:.1f} mm on "
                   f"average; with the believed one {1e3 * summary['error_m']['mean']:.0f} mm",
                   "pose error, not phase noise, sets this figure"):
        check(phrase in page, f"the page does not say {phrase!r}")


@case
def aws_warehouse_over_100_seeds(context):
    folder = context.simulate("aws_warehouse", "--seeds", "100", "--set",
                              f"world.path={context.aws_world()}")
    summary = check_summary(folder)
    check_equal(summary["located"], 1000, "located, of 1000,")
    check_between(summary["error_m"]["mean"], 0.0, 0.020, "mean error")
    check_equal(summary["over_0_3_m"], 0, "over_0_3_m")
    places = {tag["id"]: tag["truth_m"] for tag in summary["tags"]}
    check_equal(places["tag1"], [2.90, 0.57, 2.05], "place of tag1")
    check_equal(places["tag10"], [-4.85, 5.95, 1.85], "place of tag10")
    check_equal(len(places), 10, "number of tags")
    check_clear_path(folder)


# The figures in docs/mapping.md and docs/localization_on_map.md.
def check_navigation(summary):
    navigation = summary["navigation"]
    check_equal(summary["pose"], "slam", "pose")
    check_between(navigation["walls_found"], 0.95, 1.0, "walls_found")
    check_between(navigation["walls_false"], 0.0, 0.03, "walls_false")
    check_between(navigation["walls_double"], 0.0, 0.01, "walls_double")
    check_between(navigation["position_error_m"]["mean"], 0.0, 0.020, "mean pose error")
    check_between(navigation["position_error_m"]["p95"], 0.0, 0.050, "p95 of the pose error")
    check_between(navigation["yaw_error_rad"]["mean"], 0.0, math.radians(0.5), "mean yaw error")
    check_equal(navigation["goals_reached"], navigation["goals"], "goals reached")
    check_between(navigation["closest_m"], 0.01, 10.0, "closest_m")
    check_equal(navigation["times_lost"], 0, "times_lost")
    return navigation


def check_methods(folder, summary):
    """Method joint, which estimates the pose error with the tags, compared with the paper's method."""
    check_equal(summary["method_asked"], "auto", "method_asked")
    check_in("the pose is not exact", summary["method_why"], "method_why")
    joint, hyperbola = summary["compared_methods"]
    check_equal((joint["method"], hyperbola["method"]), ("joint", "hyperbola"), "methods compared")
    check_equal(joint["error_m"], summary["error_m"], "error_m of the method that was used")
    aligned = joint["aligned_error_m"]["mean"]
    check(aligned < 0.5 * hyperbola["aligned_error_m"]["mean"],
          f"aligned, joint is off by {aligned}, hyperbola by {hyperbola['aligned_error_m']['mean']}")
    check(summary["pose_error"]["corrected_rms_m"] < summary["pose_error"]["position_rms_m"],
          "the corrected pose is no closer to the truth")
    check_equal(len(read_csv(folder / "corrected_poses.csv")),
                len(read_csv(folder / "antenna_poses.csv")), "rows of corrected_poses.csv")
    page = (folder / "report.html").read_text(encoding="utf-8")
    for words in ("<h2>Methods</h2>", "After the best rigid alignment", ">joint</th>",
                  ">hyperbola</th>", "<dt>Chosen by auto</dt><dd>the pose is not exact"):
        check(words in page, f"the page lacks {words!r}")


@case
def paper_warehouse_slam(context):
    folder = context.simulate("paper_warehouse_slam")
    summary = check_summary(folder, "joint")
    check_navigation(summary)
    check_methods(folder, summary)
    check_equal(summary["located"], 10, "located")
    check_between(summary["error_m"]["mean"], 0.0, 0.060, "mean error with the robot's own pose")
    check_between(summary["pose_error"]["error_with_true_pose_m"]["mean"], 0.0, 0.015,
                  "mean error with the true pose")
    again = context.simulate("paper_warehouse_slam", "--threads", "1", name="slam_again")
    for name in ("map.pgm", "map.yaml", "reads.csv", "antenna_poses.csv", "mapping_path.csv"):
        check_equal((again / name).read_bytes(), (folder / name).read_bytes(),
                    f"{name} of the same seed on one thread")
    on_map = context.simulate("paper_warehouse_slam", "--seeds", "3", "--set",
                              f"navigation.map={folder / 'map.yaml'}", name="slam_on_map")
    given = check_navigation(check_summary(on_map, "joint"))
    check_equal(given["mapping_s"], 0.0, "mapping_s with a map given")
    check_equal(given["goals"], 15, "goals of three seeds")


@case
def warehouse_physics(context):
    """All effects enabled: the reads, and the correctness of the located tags."""
    folder = context.simulate("warehouse_physics")
    summary = read_json(folder / "summary.json")
    reads = read_csv(folder / "reads.csv")
    check_between(len(reads), 8000, 20000, "reads")
    check_equal({row["frequency_hz"] for row in reads},
                {"865700000", "866300000", "866900000", "867500000"}, "carriers")
    check_equal({row["antenna"] for row in reads}, {"left", "right"}, "antennas")
    check_equal(len({row["stamp_s"] for row in reads}), len(reads), "stamps, each of one read,")
    check(all(math.isfinite(float(row["doppler_hz"])) for row in reads), "Doppler is not finite")
    steps = [float(row["phase_rad"]) / (2 * math.pi / 4096) for row in reads]
    check(max(abs(step - round(step)) for step in steps) < 1e-3, "phases are not in 4096 steps")
    check(summary["located"] >= 6, f"only {summary['located']} of ten tags are located")
    for tag in summary["tags"]:
        if tag["verdict"] == "located":
            check(tag["error_m"] < 0.3, f"{tag['id']} is said to be located, {tag['error_m']} m off")
    check_in("jump by π", "".join(summary["warnings"]), "warnings")


@case
def warehouse_physics_broken_down(context):
    """Without any effect, the phase is exact; each added effect can only increase errors."""
    folder = context.simulate("warehouse_physics", "--breakdown", "--set", "duration_s=30",
                              "--set", "localization.known_world=false")
    rows = read_json(folder / "summary.json")["effects"]
    check_equal(rows[0]["set"], "none", "first row")
    check_equal(rows[-1]["set"], "all", "last row")
    check_equal(len(rows), 2 * 10 + 2, "rows")
    check(rows[0]["located"] >= 8, f"without any effect only {rows[0]['located']} tags are located")
    check(rows[0]["error_m"]["max"] < 1e-3, f"without any effect: {rows[0]['error_m']}")
    reflections = next(row for row in rows
                       if row["set"] == "alone" and row["effect"] == "reflections")
    mean = reflections["error_m"]["mean"] if reflections["error_m"] else math.inf
    check(reflections["located"] < rows[0]["located"] or mean > 0.01, "reflections cost nothing")


@case
def z_axis(context):
    folder = context.simulate("z_axis")
    summary = check_run_folder(folder)
    heights = [position(row)[2] for row in read_csv(folder / "truth/antenna_poses.csv")]
    # The lift is sampled at the antenna's updates: up to half of 1/15 s at 0.35 m/s short of each end.
    check_between(max(heights) - min(heights), 1.5 - 0.35 / 15, 1.5 + 1e-6, "travel of the antenna")
    check_between(min(heights), 0.5 - 1e-6, 0.52, "lowest place of the antenna")
    steps = [abs(b - a) for a, b in zip(heights, heights[1:])]
    check_near(max(steps), 0.35 / 15, 1e-5, "vertical travel between two updates")
    check_equal(summary["located"], 1, "located")
    check_between(summary["tags"][0]["error_m"], 0.0, 0.030, "error of the tag")
    check_clear_path(folder)


def check_rssi(rows, distances, gain, noise, what):
    """RSSI follows eq. (5), 40 log10 |G λ/(4πD) + n|, by its amplitude's first two moments.

    With A = G λ/(4πD), (A + n)² has the mean A² + σ² and the variance 4A²σ² + 2σ⁴.
    """
    misses, variances = [], []
    for row in rows:
        distance = distances[row["stamp_s"], row["antenna"], row["tag"]]
        amplitude = gain * SPEED_OF_LIGHT / 865.7e6 / (4.0 * math.pi * distance)
        misses.append(10.0 ** (float(row["rssi_dbm"]) / 20.0) - amplitude ** 2 - noise ** 2)
        variances.append(4.0 * amplitude ** 2 * noise ** 2 + 2.0 * noise ** 4)
    check_near(sum(misses) / math.sqrt(sum(variances)), 0.0, 5.0, f"{what}: z of the mean power")
    spread = statistics.fmean(miss ** 2 / variance for miss, variance in zip(misses, variances))
    check_near(spread, 1.0, 0.2, f"{what}: variance of the power over the expected one")


@case
def two_antennas(context):
    folder = context.simulate("two_antennas")
    check_run_folder(folder)
    distances = {(row["stamp_s"], row["antenna"], row["tag"]): float(row["distance_m"])
                 for row in read_csv(folder / "truth/distances.csv")}
    reads = by_antenna(read_csv(folder / "reads.csv"))
    check_equal({name: rows[0]["reader"] for name, rows in reads.items()},
                {"mobile": "reader_1", "fixed": "reader_2"}, "readers by antenna")
    check_rssi(reads["mobile"], distances, 3.0, 0.01, "mobile")
    check_rssi(reads["fixed"], distances, 1.0, 0.008, "fixed")
    check_clear_path(folder)


def interpolated(rows, stamp):
    """Linear interpolation between rows [t, x, y, z]; constant before the first and after the last."""
    if stamp <= rows[0][0]:
        return rows[0][1:]
    for a, b in zip(rows, rows[1:]):
        if stamp <= b[0]:
            share = (stamp - a[0]) / (b[0] - a[0])
            return tuple(p + share * (q - p) for p, q in zip(a[1:], b[1:]))
    return rows[-1][1:]


def places_by_stamp(folder):
    """(stamp, tag) → position in truth/tags.csv."""
    return {(row["stamp_s"], row["tag"]): position(row)
            for row in read_csv(folder / "truth/tags.csv")}


def phase_residuals(reads, distances, sigma):
    residuals = []
    for read in reads:
        distance = distances[read["stamp_s"], read["antenna"], read["tag"]]
        wavelength = SPEED_OF_LIGHT / float(read["frequency_hz"])
        off = float(read["phase_rad"]) - 4.0 * math.pi * distance / wavelength
        residuals.append(math.remainder(off, 2.0 * math.pi))
    check(max(map(abs, residuals)) < 6.0 * sigma,
          f"a phase is {max(map(abs, residuals)):.3f} rad off 4πD/λ")
    return residuals


@case
def moving_tags(context):
    folder = context.simulate("moving_tags")
    summary = check_run_folder(folder, "none")  # No antenna moves: an inventory.
    for tag in summary["tags"]:
        check_equal(tag["verdict"], "not_located", f"verdict of {tag['id']}")
        check_equal(tag["moved"], tag["id"] != "shelf", f"{tag['id']} moved")
        check(tag["reads"] > 100, f"{tag['id']} has only {tag['reads']} reads")
    reads = read_csv(folder / "reads.csv")
    tag_places = places_by_stamp(folder)
    antennas = {row["antenna"]: position(row)
                for row in read_csv(folder / "truth/antenna_poses.csv")}
    robot = {row["stamp_s"]: position(row) for row in read_csv(folder / "truth/robot_poses.csv")}
    trajectories = {"parcel_1": [(0, -2.2, -5, 0.8), (10, -2.2, 5, 0.8)],
                    "parcel_2": [(2, -2.2, -5, 0.8), (12, -2.2, 5, 0.8)]}
    distances = {(row["stamp_s"], row["antenna"], row["tag"]): float(row["distance_m"])
                 for row in read_csv(folder / "truth/distances.csv")}
    check_equal(len(distances), len(reads), "rows of truth/distances.csv")
    worst_distance = worst_place = 0.0
    for read in reads:
        stamp, tag = read["stamp_s"], read["tag"]
        if tag == "shelf":
            place = (-4.58, 0.0, 1.75)
        else:
            place = tag_places[stamp, tag]
            expected = (tuple(map(sum, zip(robot[stamp], (0, 0, 0.6)))) if tag == "load"
                        else interpolated(trajectories[tag], float(stamp)))
            worst_place = max(worst_place, math.dist(place, expected))
        worst_distance = max(worst_distance, abs(math.dist(place, antennas[read["antenna"]]) -
                                                 distances[stamp, read["antenna"], tag]))
    # Files have a resolution of micrometres; rounding of a position and of a distance can add up.
    check(worst_place < 2e-6, f"a tag is {worst_place} m off its trajectory")
    check(worst_distance < 2e-6, f"a true distance is off by {worst_distance} m")
    residuals = phase_residuals(reads, distances, 0.1)
    count = len(residuals)
    check_near(statistics.fmean(residuals), 0.0, 5 * 0.1 / math.sqrt(count), "mean phase residual")
    check_near(statistics.stdev(residuals), 0.1, 5 * 0.1 / math.sqrt(2 * count),
               "spread of the phase residual")
    check_clear_path(folder)


@case
def spawn(context):
    folder = context.simulate("spawn")
    summary = check_run_folder(folder)
    check_equal(summary["located"], 4, "located")
    end = summary["simulated_s"]
    inside = {"always": (0, end), "comes": (30, end), "goes": (0, 30), "visits": (15, 50)}
    stamps = collections.defaultdict(list)
    for row in read_csv(folder / "reads.csv"):
        stamps[row["tag"]].append(float(row["stamp_s"]))
    check_equal(set(stamps), set(inside), "tags read")
    for tag, (begin, last) in inside.items():
        check(begin <= min(stamps[tag]) and max(stamps[tag]) < last,
              f"{tag} is read from {min(stamps[tag])} to {max(stamps[tag])} s, "
              f"expected only from {begin} to {last} s")
        check(len(stamps[tag]) > 100, f"{tag} has only {len(stamps[tag])} reads")
    check_clear_path(folder)


# --- Reproducibility, and the stages separately ---------------------------------------------------

@case
def same_bytes_for_one_and_two_threads(context):
    for name in ("paper_warehouse", "two_antennas", "warehouse_physics"):
        one = files_in(context.simulate(name, "--threads", "1", name=f"{name}_1"))
        two = files_in(context.simulate(name, "--threads", "2", name=f"{name}_2"))
        for file in ("reads.csv", "antenna_poses.csv", "estimates.csv", "truth/distances.csv"):
            check(one[file] == two[file], f"{name}: {file} depends on the number of threads")
    noisy = ("--seeds", "4", *POSE_NOISE)
    one = files_in(context.simulate("paper_warehouse", "--threads", "1", *noisy, name="noisy_1"))
    two = files_in(context.simulate("paper_warehouse", "--threads", "2", *noisy, name="noisy_2"))
    for file in ("reads.csv", "antenna_poses.csv", "estimates.csv"):
        check(one[file] == two[file], f"with pose error, {file} depends on the number of threads")
    tags = [read_json(context.folder / name / "summary.json")["tags"]
            for name in ("noisy_1", "noisy_2")]
    check(tags[0] == tags[1], "the tags of four seeds depend on the number of threads")


@case
def different_seeds_differ(context):
    first = context.simulate("z_axis", name="first")
    second = context.simulate("z_axis", "--seed", "2", name="second")
    again = context.simulate("z_axis", "--set", "seed=2", name="again")
    check((first / "reads.csv").read_bytes() != (second / "reads.csv").read_bytes(),
          "seeds 1 and 2 give the same reads")
    check_equal((again / "reads.csv").read_bytes(), (second / "reads.csv").read_bytes(),
                "reads with --set seed=2, beside --seed 2,")
    check_equal(read_json(second / "summary.json")["seeds"], [2], "seeds")


@case
def a_seed_alone_is_as_among_many(context):
    many = read_json(context.simulate("spawn", "--seeds", "3", name="many") / "summary.json")
    alone = read_json(context.simulate("spawn", "--seed", "3", name="alone") / "summary.json")
    check_equal([tag for tag in many["tags"] if tag["seed"] == 3], alone["tags"], "tags of seed 3")


@case
def report_twice_gives_the_same_bytes(context):
    folder = context.simulate("two_antennas")
    before = files_in(folder)
    context.run_well("report", folder)
    context.run_well("report", folder)
    after = files_in(folder)
    check_equal(set(after), set(before), "files after two reports")
    for name, content in before.items():
        check(after[name] == content, f"{name} differs after two reports")


def localize(context, folder, out):
    context.run_well("localize", folder / "reads.csv", "--poses", folder / "antenna_poses.csv",
                     "--tag-heights", folder / "tag_heights.csv", "--method", "hyperbola",
                     "--out", out)
    return out


def check_same_estimates(one, other):
    """Checks that estimates agree within 0.1 mm, as reads.csv is rounded to microradians and
    antenna_poses.csv to micrometres."""
    one, other = ({(row["tag"], row["candidate"]): row for row in read_csv(folder /
                                                                            "estimates.csv")}
                  for folder in (one, other))
    if not check_equal(set(other), set(one), "tags and candidates"):
        return
    for key, row in one.items():
        check_equal(other[key]["verdict"], row["verdict"], f"verdict of {key[0]}")
        check_equal(other[key]["reads"], row["reads"], f"reads of {key[0]}")
        if row["candidate"]:
            check(math.dist(position(row), position(other[key])) < 1e-4,
                  f"{key[0]} is elsewhere: {position(row)}, {position(other[key])}")


@case
def localize_gives_what_the_run_gave(context):
    for name, settings in (("paper_warehouse", ()), ("paper_warehouse", POSE_NOISE), ("spawn", ()),
                           ("z_axis", ())):
        folder = context.simulate(name, *settings, name=f"{name}{len(settings)}")
        out = localize(context, folder, context.folder / f"localized_{name}{len(settings)}")
        check_same_estimates(folder, out)
        summary = read_json(out / "summary.json")
        check_equal(set(summary), SUMMARY_KEYS, "keys of summary.json")
        check_equal(summary["pose"], "given", "pose")
        check_equal(summary["compared_pose"], None, "compared_pose with one file of poses")
        check_equal(summary["error_m"], None, "error_m where the truth is not known")
        check((out / "report.html").exists(), "localize drew no page")
        check(not (out / "truth").exists(), "localize made up a truth")


def horizontal_rms(poses, others):
    """Horizontal RMS distance [m] between poses of the same antennas at the same stamps in two files."""
    squares = []
    for row, other in zip(read_csv(poses), read_csv(others), strict=True):
        check_equal((other["antenna"], other["stamp_s"]), (row["antenna"], row["stamp_s"]), "pose")
        squares.append(math.dist(position(row)[:2], position(other)[:2]) ** 2)
    return math.sqrt(statistics.fmean(squares))


@case
def compared_pose_is_what_the_other_poses_give(context):
    require_rosbag()
    folder = context.simulate("paper_warehouse", "--set", "pose.source=odometry")
    bag = write_bag(context.folder / "run.bag", RunBag(context.source, folder).messages())
    for pose in ("true", "odometry"):
        context.run_well("localize", bag, "--poses", pose, "--tag-heights",
                         folder / "tag_heights.csv", "--out", pose)
    for pose, other in (("true", "odometry"), ("odometry", "true")):
        out = context.folder / pose
        compared = read_json(out / "summary.json")["compared_pose"]
        alone = read_json(context.folder / other / "summary.json")
        check_equal(set(compared), {"pose", "position_rms_m", "error_m", "located"},
                    "keys of compared_pose")
        check_equal(compared["pose"], other, f"{pose}: compared_pose.pose")
        check_equal(compared["located"], alone["located"], f"{pose}: compared_pose.located")
        check_equal(compared["error_m"], alone["error_m"], f"{pose}: compared_pose.error_m")
        # Files have a resolution of micrometres.
        check_near(compared["position_rms_m"],
                   horizontal_rms(out / "antenna_poses.csv", out / "compared_poses.csv"), 2e-6,
                   f"{pose}: compared_pose.position_rms_m")
        check(compared["position_rms_m"] > 0.01, "the wheels do not slip")


@case
def localize_never_reads_truth(context):
    folder = context.simulate("paper_warehouse", *POSE_NOISE)
    with_truth = localize(context, folder, context.folder / "with")
    shutil.rmtree(folder / "truth")
    for name in ("summary.json", "estimates.csv", "top_view.json"):
        (folder / name).unlink()
    without = localize(context, folder, context.folder / "without")
    check_equal((without / "estimates.csv").read_bytes(), (with_truth / "estimates.csv").read_bytes(),
                "estimates without truth/")
    page = (without / "report.html").read_text(encoding="utf-8")
    check_in("true positions are not known", page, "the page")


if __name__ == "__main__":
    main()
