#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Time and memory of localizing thousands of tags from one long drive through a hall.

    benchmarks/long_drive.py [--tagfield build/release/bin/tagfield] [--hours 0.1 0.25 1] [--tags-an-hour 5000]
                             [--range 4] [--methods joint ml] [--threads 2] [--mcap]

A robot drives up and down aisles of 40 m, 3.5 m apart, at 0.3 m/s past tags on both sides, which are read
15 times per second within --range; its believed pose has an error of 3 cm. Prints one row per run: hours,
tags, reads, method, CPU and wall time, peak memory, number of located tags, and the mean NEES per axis
after subtraction of the mean error. With --mcap, also localizes from the run's MCAP file, whose poses by
tf are the believed ones.
"""

import argparse
import csv
import itertools
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

AISLE_M = 40.0
GAP_M = 3.5
SPEED_M_S = 0.3
POSE_ERROR = ["--pose-sigma", "0.03", "--pose-yaw-sigma", "0.5"]  # As in the scenario.


def write_scenario(path, hours, tags, range_m):
    aisles = max(2, round(hours * 3600 * SPEED_M_S / (AISLE_M + GAP_M)))
    ends = [[(0, y), (AISLE_M, y)] for y in (a * GAP_M for a in range(aisles))]
    way = [end for a, pair in enumerate(ends) for end in (pair if a % 2 == 0 else pair[::-1])]
    side = math.ceil(tags / (2 * aisles))
    places = [(AISLE_M * (k + 0.5) / side, a * GAP_M + across, (0.4, 1.0, 1.6, 2.2)[k % 4])
              for a in range(aisles) for across in (-1.45, 1.45) for k in range(side)][:tags]
    with path.with_suffix(".csv").open("w", encoding="utf-8") as table:
        table.write("tag,x_m,y_m,z_m\n")
        for i, (x, y, z) in enumerate(places):
            table.write(f"tag{i:06d},{x:.3f},{y:.3f},{z}\n")
    waypoints = ", ".join(f"[{x}, {y}]" for x, y in way[1:])
    path.write_text(f"""
name: long_drive
robots:
  - {{name: robot, start: [0, 0, 0], speed_m_s: {SPEED_M_S}, look_ahead_m: 0.6, waypoints: [{waypoints}]}}
antennas:
  - {{name: mobile, on: robot, pose: [0, 0, 1.3], rate_hz: 15, phase_noise_rad: 0.1, rssi_noise: 0.01,
     range_m: {range_m}, communication_gain: 3}}
tag_table: {path.with_suffix(".csv").name}
pose: {{source: noisy, sigma_m: 0.03, yaw_sigma_deg: 0.5}}
localization: {{tag_heights: known}}
""", encoding="utf-8")


def localized(command):
    begin = time.monotonic()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{command[0]} localize ended with {child.returncode}")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - begin, usage.ru_maxrss / 1024


def nees(estimates, truth):
    """Number of located tags, and their mean NEES in x and y after subtraction of the mean error."""
    with open(truth, encoding="utf-8") as table:
        places = {row["tag"]: row for row in csv.DictReader(table)}
    with open(estimates, encoding="utf-8") as table:
        located = [row for row in csv.DictReader(table) if row["verdict"] == "located"]
    means = []
    for axis in "xy":
        errors = [float(row[f"{axis}_m"]) - float(places[row["tag"]][f"{axis}_m"]) for row in located]
        shift = sum(errors) / max(len(errors), 1)
        ratios = [(error - shift) ** 2 / float(row[f"cov_{axis}{axis}"])
                  for error, row in zip(errors, located)]
        means.append(sum(ratios) / max(len(ratios), 1))
    return len(located), means


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tagfield", default="build/release/bin/tagfield")
    parser.add_argument("--hours", type=float, nargs="+", default=[0.1, 0.25, 1.0])
    parser.add_argument("--tags-an-hour", type=int, default=5000)
    parser.add_argument("--range", type=float, default=4.0, help="of the antenna [m]")
    parser.add_argument("--methods", nargs="+", default=["joint"])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--mcap", action="store_true", help="locate from the run's MCAP file, too")
    arguments = parser.parse_args()
    print("hours   tags     reads  from   method    CPU [s]  wall [s]  peak [MB]  located  NEES x, y")
    for hours in arguments.hours:
        with tempfile.TemporaryDirectory(prefix="long_drive-") as name:
            folder = pathlib.Path(name)
            tags = round(hours * arguments.tags_an_hour)
            scenario = folder / "drive.yaml"
            write_scenario(scenario, hours, tags, arguments.range)
            sources = {"CSV": [folder / "run/reads.csv", "--poses", folder / "run/antenna_poses.csv"]}
            if arguments.mcap:
                sources["MCAP"] = [folder / "run.mcap", "--poses", "tf", *POSE_ERROR]
            recording = ["--mcap", folder / "run.mcap"] if arguments.mcap else []
            subprocess.run([arguments.tagfield, "run", scenario, "--record-only", "--out", folder / "run", *recording],
                           check=True, stdout=subprocess.DEVNULL)
            with (folder / "run/reads.csv").open("rb") as reads:
                count = sum(1 for _ in reads) - 1
            for method, (source, reads) in itertools.product(arguments.methods, sources.items()):
                cpu, wall, peak = localized([
                    arguments.tagfield, "localize", *reads, "--scenario", scenario, "--method", method,
                    "--threads", str(arguments.threads), "--out", folder / method])
                located, means = nees(folder / method / "estimates.csv", folder / "run/truth/tags.csv")
                print(f"{hours:5g} {tags:6d} {count:9d}  {source:6} {method:8} {cpu:8.1f} {wall:9.1f} {peak:10.0f} "
                      f"{located:8d}  {means[0]:.2f}, {means[1]:.2f}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
