#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Localization under multipath, in random halls that no method was tuned to.

    benchmarks/halls.py [--tagfield build/release/bin/tagfield] [--halls 8] [--first 1] [--seeds 2]
                        [--methods auto,sar,ml] [--pose true|noisy] [--world known|unknown] [--order 2]
                        [--out DIR] [--threads 2]

Halls are drawn at random, with their number as seed: size, materials, rows of racks with goods on their
shelves, cabinets. A robot with an antenna on each side drives around all rows, past tags on the racks'
faces; the reader hops between channels, and phases have the π ambiguity. `tagfield bench` simulates and
locates. Columns for each method: located tags, tags among them with an error above 0.3 m, median, 95th
percentile and maximum of the errors, RMS of error over expected error, and mean NEES per degree of
freedom. Method auto selects multipath, as the world of a simulated hall is known; --world unknown shows
its results without this knowledge.
"""

import argparse
import csv
import math
import pathlib
import random
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent

WALLS = ["concrete", "brick", "plasterboard", "metal", "glass"]
RACKS = ["metal", "metal", "wood", "chipboard"]
GOODS = ["cardboard", "wood", "plywood", "metal"]


class Hall:
    """Boxes [(name, material, centre, size)], the path of a robot, and tags, with a number as seed."""

    def __init__(self, number):
        rng = random.Random(f"hall {number}")
        self.boxes = []
        self.rows = rng.choice((2, 2, 3))
        self.length = rng.uniform(5.0, 12.0)  # Length of a row.
        self.depth = rng.uniform(0.5, 1.2)
        self.aisle = rng.uniform(2.2, 4.5)
        self.end = rng.uniform(1.8, 3.5)  # Distance from a row's end to the wall.
        self.height = rng.uniform(3.0, 6.0)
        self.way = []
        self.tags = []
        self.add_walls(rng)
        for row in range(self.rows):
            self.add_row(rng, row)
        self.add_things(rng)
        self.drive(rng)

    def add(self, kind, material, centre, size):
        self.boxes.append((f"{kind}_{len(self.boxes)}", material, centre, size))

    def middle_of(self, row):
        return (row - (self.rows - 1) / 2) * (self.aisle + self.depth)

    def add_walls(self, rng):
        self.x = self.length / 2 + self.end
        self.y = -self.middle_of(0) + self.depth / 2 + self.aisle
        for sign in (-1, 1):
            self.add("wall", rng.choice(WALLS), (sign * (self.x + 0.1), 0, self.height / 2),
                     (0.2, 2 * self.y + 0.4, self.height))
            self.add("wall", rng.choice(WALLS), (0, sign * (self.y + 0.1), self.height / 2),
                     (2 * self.x, 0.2, self.height))
        if rng.random() < 0.5:
            self.add("roof", rng.choice(WALLS), (0, 0, self.height + 0.1), (2 * self.x, 2 * self.y, 0.2))

    def add_row(self, rng, row):
        """Boards and uprights with goods between them, set back from the face by some centimetres."""
        y, material = self.middle_of(row), rng.choice(RACKS)
        levels = [0.15, 0.15 + rng.uniform(0.6, 0.9), 0.15 + rng.uniform(1.4, 1.8)]
        for z in levels:
            self.add("board", material, (0, y, z), (self.length, self.depth, 0.03))
        for i in range(int(self.length / 2) + 1):
            x = -self.length / 2 + min(2.0 * i, self.length - 0.05)
            self.add("upright", material, (x, y, 1.1), (0.05, self.depth, 2.2))
        for z in levels:
            x = -self.length / 2 + 0.2
            while x < self.length / 2 - 0.6:
                size = rng.uniform(0.3, 0.6)
                if rng.random() < 0.6:
                    self.add("goods", rng.choice(GOODS),
                             (x + size / 2, y + rng.uniform(-0.1, 0.1), z + 0.2),
                             (size, self.depth * rng.uniform(0.5, 0.85), rng.uniform(0.25, 0.36)))
                x += size + rng.uniform(0.05, 0.5)
        for _ in range(4):
            side = rng.choice((-1, 1))
            self.tags.append(((rng.uniform(-0.45, 0.45) * self.length,
                               y + side * (self.depth / 2 + 0.01), rng.uniform(0.4, 2.0)), side))

    def add_things(self, rng):
        for _ in range(rng.randrange(1, 5)):
            size = rng.uniform(0.3, 0.8), rng.uniform(0.3, 0.6), rng.uniform(1.0, 2.2)
            side = rng.choice((-1, 1))
            self.add("cabinet", rng.choice(RACKS + GOODS),
                     (rng.uniform(-0.8, 0.8) * self.x, side * (self.y - size[1] / 2 - 0.02), size[2] / 2), size)

    def drive(self, rng):
        """The path around the rows: down one aisle, up the next, and so on."""
        beyond = self.length / 2 + 0.5 * self.end
        middles = [self.middle_of(row) - (self.depth + self.aisle) / 2 for row in range(self.rows)]
        middles.append(-middles[0])
        for i, y in enumerate(middles):
            sign = -1 if i % 2 == 0 else 1
            shift = rng.uniform(-0.15, 0.15) * self.aisle
            self.way += [(sign * beyond, y + shift), (-sign * beyond, y + shift)]


def box_sdf(name, centre, size):
    geometry = "<geometry><box><size>{:.4f} {:.4f} {:.4f}</size></box></geometry>".format(*size)
    pose = "<pose>{:.4f} {:.4f} {:.4f} 0 0 0</pose>".format(*centre)
    return (f'<model name="{name}"><static>true</static><link name="link">{pose}'
            f'<collision name="shape">{geometry}</collision></link></model>')


def write_world(hall, path):
    models = "\n".join(box_sdf(name, centre, size) for name, _, centre, size in hall.boxes)
    path.write_text(f"""<sdf version="1.6"><world name="hall">
<model name="floor"><static>true</static><link name="link"><collision name="shape">
<geometry><plane><normal>0 0 1</normal><size>50 50</size></plane></geometry></collision></link></model>
{models}
</world></sdf>
""")


def antenna_yaml(name, side):
    return f"""  - name: {name}
    reader: reader_1
    on: robot
    pose: [0, {0.1 * side}, 1.2, 0, 0, {side * math.pi / 2:.6f}]
    rate_hz: 15
    profiles: [{ROOT}/profiles/readers/speedway_r420.yaml, {ROOT}/profiles/antennas/panel_6dbi.yaml]
    channel_plan: etsi_low
    transmit_power_dbm: 29.7
"""


def drive_yaml(way, tags, order):
    """YAML of a robot on a path with its antennas, of the tags (given as lines), and of the method."""
    (x0, y0), *way = way
    heading = math.atan2(way[0][1] - y0, way[0][0] - x0)
    return f"""robots:
  - name: robot
    start: [{x0:.3f}, {y0:.3f}, {heading:.5f}]
    speed_m_s: 0.3
    look_ahead_m: 0.5
    waypoints: [{", ".join(f"[{x:.3f}, {y:.3f}]" for x, y in way)}]
antennas:
{antenna_yaml("left", 1)}    reflection_order: {order}
{antenna_yaml("right", -1)}    reflection_order: {order}
tags:
{tags}
localization:
  method: auto
  tag_heights: known
"""


def write_scenario(hall, number, order, folder):
    world = folder / f"hall{number}.sdf"
    write_world(hall, world)
    materials = "\n".join(f"    {name}: {material}" for name, material, _, _ in hall.boxes)
    tags = "\n".join(
        f"  - {{id: tag{i}, position: [{p[0]:.4f}, {p[1]:.4f}, {p[2]:.4f}], rpy: [0, 0, {side * math.pi / 2:.6f}]}}"
        for i, (p, side) in enumerate(hall.tags))
    path = folder / f"hall{number}.yaml"
    path.write_text(f"""name: hall{number}
model: multipath
tag_profile: {ROOT}/profiles/tags/monza_r6.yaml
world:
  path: {world}
  materials:
    floor: concrete
{materials}
{drive_yaml(hall.way, tags, order)}""")
    return path


def write_suite(name, scenarios, options, folder):
    """Writes a suite of scenarios, given by the names of their conditions."""
    changes = []
    if options.pose == "noisy":
        changes += ["pose.source: noisy", "pose.sigma_m: 0.01", "pose.yaw_sigma_deg: 0.5", "pose.time_constant_s: 5"]
    if options.world == "unknown":
        changes += ["localization.known_world: false"]
    under = f"\n    set: {{{', '.join(changes)}}}" if changes else ""
    if options.pose == "noisy":
        under += "\n    believed: unknown"
    conditions = [f"  - name: {condition}\n    scenario: {scenario}{under}" for condition, scenario in scenarios.items()]
    suite = folder / f"{name}.yaml"
    suite.write_text(f"name: {name}\nseeds: {options.seeds}\nmethods: [{options.methods}]\n"
                     "conditions:\n" + "\n".join(conditions) + "\n")
    return suite


def number_of(text):
    return float(text) if text else None


def quantile(values, share):
    values = sorted(values)
    return values[min(int(share * len(values)), len(values) - 1)] if values else math.nan


def print_row(name, rows):
    located = [row for row in rows if row["verdict"] == "located"]
    errors = [number_of(row["error_m"]) for row in located]
    ratios = [e / number_of(row["expected_error_m"]) for e, row in zip(errors, located)]
    nees = [number_of(row["nees"]) / number_of(row["nees_dof"]) for row in located if number_of(row["nees"]) is not None]
    mean = sum(nees) / len(nees) if nees else math.nan
    rms = math.sqrt(sum(r * r for r in ratios) / len(ratios)) if ratios else math.nan
    print(f"{name:24} {len(located):4} of {len(rows):4} {sum(e > 0.3 for e in errors):5} "
          f"{1000 * quantile(errors, 0.5):8.1f} {1000 * quantile(errors, 0.95):8.0f} {1000 * max(errors, default=math.nan):8.0f} "
          f"{rms:8.2f} {mean:8.2f}", flush=True)


def print_table(path, methods):
    """Prints statistics from a tags table of `tagfield bench`, by method and condition, and by method."""
    with open(path, newline="") as table:
        rows = list(csv.DictReader(table))
    print(f"{'':24} {'located':>12} {'wrong':>5} {'median':>8} {'95 %':>8} {'max mm':>8} {'err/exp':>8} {'NEES/dof':>8}")
    for method in methods:
        mine = [row for row in rows if row["name"] == method]
        for condition in dict.fromkeys(row["condition"] for row in mine):
            print_row(f"{method}, {condition}", [row for row in mine if row["condition"] == condition])
        print_row(f"{method}, all", mine)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tagfield", default=str(ROOT / "build/release/bin/tagfield"))
    parser.add_argument("--halls", type=int, default=8)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--order", type=int, default=2)
    parser.add_argument("--methods", default="auto,sar,ml")
    parser.add_argument("--pose", choices=("true", "noisy"), default="true")
    parser.add_argument("--world", choices=("known", "unknown"), default="known", help="what auto may make use of")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path, help="keep the halls and the bench there")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = (options.out or pathlib.Path(temporary)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        numbers = range(options.first, options.first + options.halls)
        scenarios = {f"hall {number}": write_scenario(Hall(number), number, options.order, folder)
                     for number in numbers}
        suite = write_suite("halls", scenarios, options, folder)
        subprocess.run([options.tagfield, "bench", str(suite), "--out", str(folder / "bench"), "--no-page",
                        "--threads", str(options.threads)], check=True, stdout=subprocess.DEVNULL)
        print_table(folder / "bench/tags.csv", options.methods.split(","))


if __name__ == "__main__":
    main()
