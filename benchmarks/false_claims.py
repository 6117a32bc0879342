#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""False claims: how often the commands report positions that the data cannot support.

    benchmarks/false_claims.py [--tagfield build/release/bin/tagfield] [--cases 1000] [--seed 1]
                               [--methods auto,hyperbola,…] [--room-methods auto,fixed,…]
                               [--conditions "random phases;wrong sign"]

Each case is a tag that cannot be located from its reads, or only wrongly. A claim is a tag reported as
located; it is false if no position can be right, or if its error exceeds five times the expected
error. Prints the numbers of claims and of false claims for each condition and method; the exit code is
1 if any of them has more than one false claim per hundred cases. `track` and `calibrate` are tested by
the conditions "track random phases" and "calibrate random phases".
"""

import argparse
import csv
import math
import pathlib
import random
import subprocess
import sys
import tempfile

import made_tables as made

ROOT = pathlib.Path(__file__).resolve().parent.parent
METHODS = "auto,hyperbola,least_squares,ml,joint,sar,robust,dah,particle,scan,trilateration"
ROOM_METHODS = "auto,fixed,trilateration,landmarc"
BATCH = 50  # Tags per run of the command.


def curve(rate=15.0, speed=0.3):
    """A sinusoidal path, 8 m long in x."""
    return [(i / rate, (speed * i / rate, 0.7 * math.sin(speed * i / rate)))
            for i in range(int(8 / speed * rate))]


def beside(rng):
    return rng.uniform(1.0, 7.0), rng.choice((-1, 1)) * rng.uniform(1.5, 3.0)


def tag_on(way, visit, rng, place=None, **how):
    place = place or beside(rng)
    return made.read_tag(visit(way, rng), place, rng, **how), place


def nothing(change, visit=made.one_channel, way=curve):
    """A condition whose reads are changed so that no position is right."""
    def make(rng):
        rows, _ = tag_on(way(), visit, rng)
        return change(rows, rng), None
    return make


def random_phases(rows, rng):
    return made.with_phase(rows, lambda _: rng.uniform(0, made.TURN))


def constant_phases(rows, rng):
    value = rng.uniform(0, made.TURN)
    return made.with_phase(rows, lambda _: value)


def two_tags(rng):
    """Two tags with the same EPC, read alternately."""
    first, place = tag_on(curve(), made.one_channel, rng)
    second, _ = tag_on(curve(), made.one_channel, rng)
    return [row for i, (a, b) in enumerate(zip(first, second)) for row in (a if i % 2 else b,)], None


def late(by):
    def make(rng):
        rows, place = tag_on(curve(), made.one_channel, rng)
        return [(t + by, *row) for t, *row in rows], place
    return make


def moving(rng):
    speed, heading = rng.uniform(0.02, 0.3), rng.uniform(0, made.TURN)
    rows, _ = tag_on(curve(), made.one_channel, rng,
                     velocity=(speed * math.cos(heading), speed * math.sin(heading)))
    return rows, None


def on_the_line(rng):
    """A tag on the line of a straight path or its extension, up to a few centimetres off."""
    place = rng.uniform(-1.0, 7.0), rng.gauss(0, 0.03)
    return tag_on(made.straight(), made.one_channel, rng, place)


def wrong_sign(rng):
    rows, place = tag_on(curve(), made.one_channel, rng)
    return made.with_phase(rows, lambda phase: -phase), None


def other_run(rng):
    """The poses are those of another drive, with the same times along another curve."""
    rows, _ = tag_on(curve(), made.one_channel, rng)
    return rows, None


#: By name: the function that generates a tag's reads and position (None if no position is right), and
#: the function that generates the poses, unless they are those of the reads.
CONDITIONS = {
    "random phases": (nothing(random_phases), None),
    "random phases, hopping": (nothing(random_phases, made.hopping), None),
    "random phases on a rail": (nothing(random_phases, way=made.rail), None),
    "constant phases": (nothing(constant_phases), None),
    "two tags of one EPC": (two_tags, None),
    "stamps 0.2 s late": (late(0.2), curve),
    "stamps 1 s late": (late(1.0), curve),
    "wrong sign": (wrong_sign, None),
    "slow tags": (moving, None),
    "on the line of a straight path": (on_the_line, None),
    "poses of another run": (other_run, lambda: [(t, (x, -y / 2 + 0.1 * x)) for t, (x, y) in curve()]),
}


def random_strength(rows, rng):
    return [(t, p, carrier, phase, rng.uniform(-75, -35)) for t, p, carrier, phase, _ in rows]


def no_strength_law(rng):
    """Random phases and random RSSI, without information about the position."""
    rows, _ = tag_on(curve(), made.one_channel, rng)
    return random_strength(random_phases(rows, rng), rng), None


CONDITIONS["random phases and RSSI"] = (no_strength_law, None)
#: Conditions that do not affect RSSI, so that methods by RSSI can locate the tag.
OF_PHASE = ("random phases", "random phases, hopping", "random phases on a rail", "constant phases",
            "wrong sign")

CORNERS = {"p0": (0, 0), "p1": (6, 0), "p2": (6, 6), "p3": (0, 6)}


def swapped(antennas):
    return {**antennas, "p0": antennas["p1"], "p1": antennas["p0"]}


def changed(tags, rng, phase=lambda value, rng: value, rssi=lambda value, rng: value):
    """Reads with each phase changed, and RSSI changed once per tag and antenna."""
    result = {}
    for tag, rows in tags.items():
        by_antenna = {}
        result[tag] = [(t, a, c, phase(p, rng), by_antenna.setdefault(a, rssi(s, rng)))
                       for t, a, c, p, s in rows]
    return result


#: Fixed antennas, by name: whether positions can be right, and changes to reads and to antennas.
ROOMS = {
    "at rest, as it is": (True, lambda tags, rng: tags, None),
    "at rest, random RSSI": (False, lambda tags, rng: changed(
        tags, rng, lambda *_: rng.uniform(0, made.TURN), lambda *_: rng.uniform(-75, -35)), None),
    "at rest, random phases": (True, lambda tags, rng: changed(
        tags, rng, lambda *_: rng.uniform(0, made.TURN)), None),
    "at rest, wrong sign": (True, lambda tags, rng: changed(tags, rng, lambda p, _: -p), None),
    "at rest, antennas swapped": (True, lambda tags, rng: tags, swapped),
}


def room_condition(name, method, references, options):
    """Numbers of claims, false claims and cases, for rooms with 20 tags each."""
    is_true, change, move = ROOMS[name]
    rng = random.Random(f"{options.seed} {name} {references}")
    claims = false = 0
    for _ in range(0, options.cases, 20):
        places = {f"t{i:02d}": (rng.uniform(0.3, 5.7), rng.uniform(0.3, 5.7))
                  for i in range(20 + references)}
        tags = change(made.read_in_room(places, CORNERS, rng), rng)
        known = dict(list(places.items())[:references])
        with tempfile.TemporaryDirectory() as folder:
            made.write_room(folder, tags, move(CORNERS) if move else CORNERS, known)
            extra = ["--reference", f"{folder}/references.csv"] if known else []
            found, _ = made.localize(options.tagfield, folder, "--method", method, "--tag-height", "0",
                                     "--box", "0", "0", "6", "6", *extra)
        for tag, rows in found.items():
            if rows[0]["verdict"] == "located" and tag not in known:
                claims += 1
                false += is_false(rows[0], places[tag] if is_true else None)
    return claims, false, options.cases


def is_false(row, place):
    if place is None:
        return True
    error = math.dist((float(row["x_m"]), float(row["y_m"])), place)
    return error > 5 * float(row["expected_error_m"])


def localize_condition(name, method, options):
    """Numbers of claims, false claims and cases."""
    make, poses = CONDITIONS[name]
    rng = random.Random(f"{options.seed} {name}")
    claims = false = 0
    for _ in range(0, options.cases, BATCH):
        tags, places = {}, {}
        for i in range(BATCH):
            tags[f"t{i}"], places[f"t{i}"] = make(rng)
        with tempfile.TemporaryDirectory() as folder:
            made.write(folder, tags, poses and poses())
            found, _ = made.localize(options.tagfield, folder, "--method", method)
        for tag, rows in found.items():
            if rows[0]["verdict"] == "located":
                claims += 1
                false += is_false(rows[0], places[tag])
    return claims, false, options.cases


def track_random(options):
    """Tracking from random phases at one fixed antenna."""
    rng = random.Random(f"{options.seed} track")
    claims = 0
    for _ in range(0, options.cases, BATCH):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            visits = [(i / 30, (0.0, 0.0), 866.9e6) for i in range(150)]
            made.write(folder, {f"t{i}": random_phases(made.read_tag(visits, (2, 1), rng), rng)
                                for i in range(BATCH)}, [(0.0, (0.0, 0.0))])
            subprocess.run([options.tagfield, "track", folder / "reads.csv", "--poses",
                            folder / "poses.csv", "--lane", "0", "1.5", "0", "--tag-height", "0",
                            "--out", folder / "out"], check=True, capture_output=True)
            with open(folder / "out/verdicts.csv", encoding="utf-8") as file:
                claims += sum(row["verdict"] == "tracked" for row in csv.DictReader(file))
    return claims, claims, options.cases


def calibrate_random(options):
    """Calibration from random phases of five reference tags; each antenna is a case."""
    rng = random.Random(f"{options.seed} calibrate")
    claims = 0
    cases = max(options.cases // 10, 1)
    for _ in range(cases):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            places = {f"t{i}": beside(rng) for i in range(5)}
            made.write(folder, {tag: random_phases(made.read_tag(
                made.one_channel(curve(), rng), place, rng), rng) for tag, place in places.items()})
            (folder / "tags.csv").write_text("tag,x_m,y_m,z_m\n" + "".join(
                f"{tag},{x},{y},0\n" for tag, (x, y) in places.items()), encoding="utf-8")
            result = subprocess.run(
                [options.tagfield, "calibrate", folder / "reads.csv", "--poses",
                 folder / "poses.csv", "--tags", folder / "tags.csv", "--out",
                 folder / "profile.yaml"], capture_output=True, check=False)
            claims += result.returncode == 0
    return claims, claims, cases


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tagfield", default=str(ROOT / "build/release/bin/tagfield"))
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--methods", default=METHODS)
    parser.add_argument("--room-methods", default=ROOM_METHODS)
    parser.add_argument("--conditions", default="")
    options = parser.parse_args()
    wanted = [word.strip() for word in options.conditions.split(";") if word]
    failed = False

    def tell(label, outcome):
        nonlocal failed
        claims, false, cases = outcome
        failed = failed or false > 0.01 * cases
        print(f"{label:<48} {claims:>5} claims of {cases}, {false} false", flush=True)

    for name in CONDITIONS:
        for method in options.methods.split(","):
            if method == "trilateration" and name in OF_PHASE:
                continue
            if not wanted or name in wanted:
                tell(f"{name}: {method}", localize_condition(name, method, options))
    for name in ROOMS:
        for method in options.room_methods.split(","):
            for references in (0, 4):
                if not wanted or name in wanted:
                    tell(f"{name}, {references} references: {method}",
                         room_condition(name, method, references, options))
    if not wanted or "track random phases" in wanted:
        tell("track random phases", track_random(options))
    if not wanted or "calibrate random phases" in wanted:
        tell("calibrate random phases", calibrate_random(options))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
