#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Cost of RFID in a gz-sim server: a set of tags and four antennas at 15 Hz, and the world without them.

    benchmarks/gz_benchmark.py [--build build/release] [--tags 10000] [--seconds 10] [--runs 3]
                               [--real-time 1]

Prints wall times, real-time factors and their ratio, and the time that an antenna update adds to a
simulation step. Needs a build with tests and gz-sim (docs/gz.md).
"""

import argparse
import json
import pathlib
import re
import statistics
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(TOP / "tests/gz"))
import gz  # noqa: E402  pylint: disable=wrong-import-position
from common import Context  # noqa: E402  pylint: disable=wrong-import-position


def world(folder, tags, real_time):
    """The world without RFID, and with it."""
    rows = "".join(f"t{i},{0.01 * (i % 100)},{0.01 * (i // 100)},0\n" for i in range(tags))
    table = pathlib.Path(folder) / "tags.csv"
    table.write_text(f"epc,x_m,y_m,z_m\n{rows}", encoding="utf-8")
    shelf = gz.model("shelf", "2 0 1 0 0 0", gz.sensor(
        "set", "rfid_tag_set", f"<table>file://{table}</table>"))
    gates = [gz.antenna(f"gate{i}", 0, i, 1) for i in range(4)]
    pace = f"<real_time_factor>{real_time}<"
    return [gz.world(*parts).replace("<mcap>run.mcap</mcap>", "").replace(
        "<real_time_factor>0<", pace) for parts in ([], [shelf, *gates])]


def wall_s(said):
    return float(re.search(r"^wall ([0-9.e+-]+)$", said, re.MULTILINE).group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--build", type=pathlib.Path, default=TOP / "build/release")
    parser.add_argument("--tags", type=int, default=10_000)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--real-time", type=float, default=1.0, help="0 for as fast as it can")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        context = Context(None, TOP, options.build.resolve(), pathlib.Path(folder))
        worlds = world(folder, options.tags, options.real_time)
        times = ([], [])
        cost = {}
        for _ in range(options.runs):
            for text, of_world in zip(worlds, times):
                said = gz.serve(context, text, [f"run {options.seconds}"],
                                ["env", "TAGFIELD_REPORT_COST=1"])
                of_world.append(wall_s(said))
                cost = json.loads(re.search(r'^\{"updates".*\}$', said, re.MULTILINE).group(0))
    without, with_rfid = (statistics.median(of_world) for of_world in times)
    print(f"{options.seconds:g} s simulated, {options.tags} tags, 4 antennas at 15 Hz, median of "
          f"{options.runs}")
    print(f"without RFID  {without:.2f} s, real-time factor {options.seconds / without:.2f}")
    print(f"with RFID     {with_rfid:.2f} s, real-time factor {options.seconds / with_rfid:.2f}, "
          f"ratio {without / with_rfid:.3f}")
    print(f"an update     {cost['physics_ms']:.4f} ms of the step, {cost['reads_ms']:.2f} ms of the "
          f"thread that makes reads ({cost['reads']} reads)")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except gz.Skip as missing:
        print(f"gz_benchmark: {missing}", file=sys.stderr)
        sys.exit(77)
