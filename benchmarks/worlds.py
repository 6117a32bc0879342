#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Localization under multipath, in third-party worlds.

    PYTHONPATH=build/release/lib/python benchmarks/worlds.py WORLD… [--model-path DIR]
        [--tagfield build/release/bin/tagfield] [--drives 4] [--tags 10] [--before 0.01 0.2] [--seeds 1]
        [--methods auto] [--pose true|noisy] [--order 2] [--out DIR] [--threads 2]

In each world (SDF), a robot with an antenna on each side drives --drives random routes of two straight legs through
free space, with the world's name and the route's number as seed. --tags tags are 1 to 20 cm (--before) in front of
surfaces that the route passes within 0.6 to 3 m in line of sight. The reader hops between channels, and phases have
the π ambiguity. `tagfield bench` simulates and locates; the columns are those of benchmarks/halls.py. With --pose
noisy, the believed pose has an error of 1 cm and 0.5°, which is not stated to the methods. Method auto selects
multipath, as a simulated world is known; --methods robust shows results without this knowledge.
"""

import argparse
import csv
import math
import pathlib
import random
import subprocess
import tempfile

import numpy as np
import tagfield

import halls

CELL_M = 0.05
CLEARANCE_M = 0.35  # Half the robot's width, plus a margin.
MARGIN_M = 0.5  # Beyond the outermost solid.


class Floor:
    """Grid of cells occupied by solids between 0.2 and 2 m above the floor, and the solids' outlines."""

    def __init__(self, world, model_path):
        scenario = tagfield.load(write_probe(world, model_path), allow_outside=True, skip_missing=True)
        self.rings = [np.asarray(ring) for _, rings in scenario.outlines() for ring in rings if len(ring) > 2]
        if not self.rings:
            raise SystemExit(f"{world}: nothing stands between 0.2 and 2 m above the floor")
        corners = np.vstack(self.rings)
        self.low = corners.min(axis=0) - MARGIN_M
        size = np.ceil((corners.max(axis=0) + MARGIN_M - self.low) / CELL_M).astype(int) + 1
        self.taken = np.zeros(size, bool)
        for ring in self.rings:
            self.fill(ring)

    def fill(self, ring):
        """Marks cells whose centres are inside the ring (even-odd rule), and all cells on the ring."""
        for p, q in zip(ring, np.roll(ring, -1, axis=0)):
            steps = max(2, int(np.hypot(*(q - p)) / (0.4 * CELL_M)))
            cells = self.cells(p + np.linspace(0, 1, steps)[:, None] * (q - p))
            self.taken[cells[:, 0], cells[:, 1]] = True
        first, last = self.cells(np.array([ring.min(axis=0), ring.max(axis=0)]))
        x, y = np.meshgrid(*(np.arange(a, b + 1) for a, b in zip(first, last)), indexing="ij")
        middles = self.low + (np.stack([x, y], -1) + 0.5) * CELL_M
        inside = np.zeros(x.shape, bool)
        for (px, py), (qx, qy) in zip(ring, np.roll(ring, -1, axis=0)):
            if py == qy:
                continue
            crosses = (py > middles[..., 1]) != (qy > middles[..., 1])
            at = px + (middles[..., 1] - py) / (qy - py) * (qx - px)
            inside ^= crosses & (middles[..., 0] < at)
        self.taken[x[inside], y[inside]] = True

    def cells(self, points):
        return ((points - self.low) / CELL_M).astype(int)

    def is_free(self, p, q, radius=0.0):
        """Whether a disc can move straight from p to q without touching an occupied cell."""
        way = q - p
        length = np.hypot(*way)
        along = p + np.linspace(0, 1, max(2, int(length / CELL_M) + 1))[:, None] * way
        if radius == 0.0:
            places = along
        else:
            ring = [(radius * share * math.cos(a), radius * share * math.sin(a))
                    for share in (0.25, 0.5, 0.75, 1.0) for a in np.linspace(0, math.tau, 16, endpoint=False)]
            places = (along[:, None, :] + np.array([(0.0, 0.0)] + ring)[None]).reshape(-1, 2)
        cells = self.cells(places)
        if (cells < 0).any() or (cells >= self.taken.shape).any():
            return False
        return not self.taken[cells[:, 0], cells[:, 1]].any()


def world_yaml(world, model_path):
    paths = f", model_paths: [{model_path.resolve()}]" if model_path else ""
    return f"world: {{path: {world.resolve()}{paths}}}"


def write_probe(world, model_path):
    """Writes a minimal scenario with the world, from which its outlines are loaded."""
    path = pathlib.Path(tempfile.mkdtemp()) / "probe.yaml"
    path.write_text(f"""name: probe
{world_yaml(world, model_path)}
robots: [{{name: robot, start: [0, 0, 0], speed_m_s: 0.3, waypoints: [[0, 0], [1, 0]]}}]
antennas: [{{name: a, on: robot, pose: [0, 0, 1, 0, 0, 0], rate_hz: 15}}]
tags: [{{id: t, position: [1, 1, 1]}}]
""")
    return path


def draw_route(floor, rng):
    """A random route of two legs of 2 to 6 m, or None if none was found."""
    upper = floor.low + np.array(floor.taken.shape) * CELL_M

    def anywhere():
        return np.array([rng.uniform(floor.low[i], upper[i]) for i in (0, 1)])

    for _ in range(20000):
        p = anywhere()
        route = [p]
        heading = rng.uniform(-math.pi, math.pi)
        for turn in (0.0, rng.choice((-1, 1)) * rng.uniform(0.3, 1.8)):
            heading += turn
            length = rng.uniform(2.0, 6.0)
            q = route[-1] + length * np.array([math.cos(heading), math.sin(heading)])
            if not floor.is_free(route[-1], q) or not floor.is_free(route[-1], q, CLEARANCE_M):
                break
            route.append(q)
        if len(route) == 3 and indoors(floor, route):
            return route
    return None


def indoors(floor, route):
    """Whether there are solids within 6 m of the route's corner in at least half of the directions."""
    middle = route[1]
    near = sum(not floor.is_free(middle, middle + 6.0 * np.array([math.cos(a), math.sin(a)]))
               for a in np.linspace(0, math.tau, 12, endpoint=False))
    return near >= 6


def draw_tags(floor, route, count, before_m, rng):
    edges = [(p, q) for ring in floor.rings for p, q in zip(ring, np.roll(ring, -1, axis=0))
             if np.hypot(*(q - p)) > 0.05]
    stations = np.vstack([p + np.linspace(0.1, 0.9, 9)[:, None] * (q - p) for p, q in zip(route, route[1:])])
    near = [(p, q) for p, q in edges if np.min(np.hypot(*((p + q) / 2 - stations).T)) < 3 + np.hypot(*(q - p))]
    tags = []
    for _ in range(20000):
        if len(tags) == count or not near:
            break
        p, q = rng.choice(near)
        normal = np.array([q[1] - p[1], p[0] - q[0]]) / np.hypot(*(q - p))
        on = p + rng.random() * (q - p)
        side = rng.choice((-1, 1))
        off = rng.uniform(*before_m)
        place, before = on + side * off * normal, on + side * (off + 0.11) * normal
        distance = np.hypot(*(stations - place).T)
        best = stations[np.argmin(distance)]
        seen = [s for s in stations if floor.is_free(before, s) and (s - place) @ (side * normal) > 0]
        if not 0.6 < distance.min() < 3.0 or len(seen) < 4 or not floor.is_free(before, best):
            continue
        tags.append((place[0], place[1], rng.uniform(0.4, 1.8), math.atan2(*(side * normal)[::-1])))
    return tags


def write_scenario(name, world, route, tags, options, path):
    listed = "\n".join(f"  - {{id: tag{i}, position: [{x:.4f}, {y:.4f}, {z:.4f}], rpy: [0, 0, {yaw:.5f}]}}"
                       for i, (x, y, z, yaw) in enumerate(tags))
    path.write_text(f"""name: {name}
model: multipath
tag_profile: {halls.ROOT}/profiles/tags/monza_r6.yaml
{world_yaml(world, options.model_path)}
{halls.drive_yaml(route, listed, options.order)}""")
    return path


def write_scenarios(options, folder):
    """Writes scenarios of all drives through all worlds; returns their paths by name."""
    scenarios = {}
    for world in options.worlds:
        floor = Floor(world, options.model_path)
        for number in range(1, options.drives + 1):
            rng = random.Random(f"{world.stem} {number}")
            route = draw_route(floor, rng)
            tags = draw_tags(floor, route, options.tags, options.before, rng) if route else []
            if not tags:
                print(f"{world.stem} {number}: no route past surfaces was found")
                continue
            name = f"{world.stem}_{number}"
            scenarios[name] = write_scenario(name, world, route, tags, options, folder / f"{name}.yaml")
    return scenarios


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("worlds", nargs="+", type=pathlib.Path, metavar="WORLD")
    parser.add_argument("--model-path", type=pathlib.Path, help="folder of the worlds' models")
    parser.add_argument("--tagfield", default=str(halls.ROOT / "build/release/bin/tagfield"))
    parser.add_argument("--drives", type=int, default=4)
    parser.add_argument("--tags", type=int, default=10)
    parser.add_argument("--before", type=float, nargs=2, default=(0.01, 0.2), metavar="M",
                        help="least and greatest distance of tags from their surface [m] (default: 0.01 0.2)")
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--order", type=int, default=2)
    parser.add_argument("--methods", default="auto")
    parser.add_argument("--pose", choices=("true", "noisy"), default="true")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path, help="keep the scenarios and the bench there")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = (options.out or pathlib.Path(temporary)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        suite = halls.write_suite("worlds", write_scenarios(options, folder), options, folder)
        command = [options.tagfield, "bench", str(suite), "--out", str(folder / "bench"), "--no-page",
                   "--threads", str(options.threads), "--allow-outside", "--skip-missing"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        halls.print_table(folder / "bench/tags.csv", options.methods.split(","))


if __name__ == "__main__":
    main()
