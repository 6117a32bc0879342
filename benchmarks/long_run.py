#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Peak memory of long runs: a hall with many tags, hour after hour, with results written continuously.

    benchmarks/long_run.py [--tagfield build/release/bin/tagfield] [--hours 1 10] [--tags 10000]

Two portals with one antenna each read tags within 7 m, and a robot with a third antenna drives the same
loop repeatedly. Prints one row per run: hours, tags, reads, size of the tables, peak memory, time.
"""

import argparse
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

ROUND = [(-20, -10), (20, -10), (20, 10), (-20, 10)]
ROUND_S = 120.0 / 0.5 + 20.0  # length over speed, plus time for turning


def write_scenario(folder, hours, tags):
    columns = 100
    with (folder / "tags.csv").open("w", encoding="utf-8") as table:
        table.write("tag,x_m,y_m,z_m\n")
        for i in range(tags):
            x, y = i % columns - columns / 2, (i // columns) * 0.4 - 20
            table.write(f"tag{i},{0.5 * x},{y:.2f},{1 + i % 3 * 0.5}\n")
    rounds = int(hours * 3600 / ROUND_S) + 2
    waypoints = ", ".join(f"[{x}, {y}]" for x, y in ROUND * rounds)
    (folder / "long.yaml").write_text(f"""
name: long
duration_s: {hours * 3600}
time_step_s: 0.05
robots:
  - {{name: robot, start: [-20, -10, 0], speed_m_s: 0.5, waypoints: [{waypoints}]}}
antennas:
  - {{name: portal_1, pose: [-24, 0, 2.5], rate_hz: 0.2}}
  - {{name: portal_2, pose: [24, 0, 2.5], rate_hz: 0.2}}
  - {{name: mobile, on: robot, pose: [0, 0, 1.5], rate_hz: 0.5}}
tag_table: tags.csv
""", encoding="utf-8")
    return folder / "long.yaml"


def measured(tagfield, hours, tags):
    with tempfile.TemporaryDirectory(prefix="long_run-") as name:
        folder = pathlib.Path(name)
        scenario = write_scenario(folder, hours, tags)
        begin = time.monotonic()
        subprocess.run([tagfield, "run", scenario, "--record-only", "--out", folder / "out"],
                       check=True, stdout=subprocess.DEVNULL)
        seconds = time.monotonic() - begin
        files = [path for path in (folder / "out").rglob("*.csv")]
        with (folder / "out/reads.csv").open("rb") as reads:
            count = sum(1 for _ in reads) - 1
        return count, sum(path.stat().st_size for path in files), seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tagfield", default="build/release/bin/tagfield")
    parser.add_argument("--hours", type=float, nargs="+", default=[1.0, 10.0])
    parser.add_argument("--tags", type=int, default=10_000)
    arguments = parser.parse_args()
    print("hours   tags      reads  tables [MB]  peak [MB]  time [s]")
    for hours in sorted(arguments.hours):  # Sorted, as ru_maxrss is that of the largest child so far.
        count, size, seconds = measured(arguments.tagfield, hours, arguments.tags)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
        print(f"{hours:5g} {arguments.tags:6d} {count:10d} {size / 1e6:12.1f} {peak:10.1f} {seconds:9.1f}",
              flush=True)


if __name__ == "__main__":
    sys.exit(main())
