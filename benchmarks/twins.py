#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Synthetic twins of real data: reads generated from equations, located by the command, and compared
with the Cramér-Rao bound of the same data.

    benchmarks/twins.py [--tagfield build/release/bin/tagfield] [--tags 40] [--seed 1]
                        [--method auto] [--conditions rail sequential,…] [--pose-sigma 0]
    benchmarks/twins.py --write DIR [--tags 40] [--seed 1] [--method auto,sar] …

Prints for each condition: the number of located tags, the root mean square of error over the standard
deviation of the Cramér-Rao bound (which is computed without outliers), that of error over expected
error, and how many errors exceed five times the expected error. For N tags, an efficient estimator has
a ratio to the bound of about 1 ± 1/sqrt(2 N). With --write, nothing is located: the same reads are
written as recordings to DIR, with a suite for `tagfield bench DIR/suite.yaml`.
"""

import argparse
import math
import pathlib
import random
import sys
import tempfile

import made_tables as made

ROOT = pathlib.Path(__file__).resolve().parent.parent
SIGMA = 0.1


def plain(rows, _rng):
    return rows, rows


def lost_to_outliers(share):
    def change(rows, rng):
        clean = [row for row in rows if rng.random() >= share]
        kept = {id(row) for row in clean}
        return [row if id(row) in kept else row[:3] + (rng.uniform(0, made.TURN), row[4])
                for row in rows], clean
    return change


def turned(rows, rng):
    return made.pi_ambiguity(rows, rng), rows


def stepped(rows, _rng):
    return made.stepped(rows), rows


#: By name: the function that assigns channels to the positions of a path, and the change to the reads.
CONDITIONS = {
    "one channel": (made.one_channel, plain),
    "sequential": (made.sequential, plain),
    "interleaved": (made.interleaved, plain),
    "all channels at each stop": (made.all_at_each, plain),
    "hopping": (made.hopping, plain),
    "pi ambiguity": (made.one_channel, turned),
    "outliers 2 %": (made.one_channel, lost_to_outliers(0.02)),
    "outliers 5 %": (made.one_channel, lost_to_outliers(0.05)),
    "4096 steps": (made.one_channel, stepped),
}
WAYS = {"circle": made.circle, "rail": lambda: made.rail(stops=100, step=0.01)}


def place_beside(way, rng):
    if way == "rail":
        return rng.uniform(0.2, 0.8), rng.uniform(0.5, 0.9)
    angle, away = rng.uniform(0, made.TURN), rng.uniform(2.3, 4.0)
    return away * math.cos(angle), away * math.sin(angle)


def twin(way, name, options):
    """Rows and positions by tag, and the standard deviation of each tag's bound."""
    visit, change = CONDITIONS[name]
    rng = random.Random(f"{options.seed} {way} {name}")
    tags, bounds, places = {}, {}, {}
    for i in range(options.tags):
        tag = f"t{i}"
        visits = visit(WAYS[way](), rng)
        places[tag] = place_beside(way, rng)
        rows, telling = change(made.read_tag(visits, places[tag], rng, SIGMA), rng)
        tags[tag] = rows
        bounds[tag] = math.sqrt(made.bound_trace(telling, places[tag], SIGMA))
    return tags, places, bounds


def write(way, name, options):
    """Writes the recording to files and returns its condition for the suite."""
    label = f"{way} {name}"
    tags, places, _ = twin(way, name, options)
    folder = label.replace(" %", "_percent").replace(" ", "_")
    (options.write / folder).mkdir(parents=True, exist_ok=True)
    made.write(options.write / folder, tags)
    (options.write / folder / "truth.csv").write_text("tag,x_m,y_m\n" + "".join(
        f"{tag},{x},{y}\n" for tag, (x, y) in places.items()), encoding="utf-8")
    side = ", side: +y" if way == "rail" else ""
    believed = {None: "", 0.0: "    believed: exact\n"}.get(
        options.pose_sigma, f"    believed: {{sigma_m: {options.pose_sigma}}}\n")
    return (f"  - name: {label}\n    recording: {{reads: {folder}/reads.csv, poses: {folder}/poses.csv, "
            f"truth: {folder}/truth.csv{side}}}\n{believed}")


def write_suite(conditions, options):
    (options.write / "suite.yaml").write_text(
        f"name: twins\ndescription: Synthetic twins of real data\nmethods: [{options.method}]\n"
        "conditions:\n" + "".join(conditions), encoding="utf-8")


def run(program, way, name, options):
    """Errors over the bound's standard deviation, errors over expected errors, and the method's name."""
    tags, places, bounds = twin(way, name, options)
    area = ["--side=+y"] if way == "rail" else []
    sigma = [] if options.pose_sigma is None else ["--pose-sigma", str(options.pose_sigma)]
    with tempfile.TemporaryDirectory() as folder:
        made.write(folder, tags)
        found, said = made.localize(program, folder, "--method", options.method, *area, *sigma)
    ratios, honest = [], []
    for tag, rows in found.items():
        if rows[0]["verdict"] != "located":
            continue
        error = math.dist((float(rows[0]["x_m"]), float(rows[0]["y_m"])), places[tag])
        ratios.append(error / bounds[tag])
        honest.append(error / float(rows[0]["expected_error_m"]))
    chosen = next((line.split()[1].rstrip(",") for line in said.splitlines()
                   if line.startswith("method:")), options.method)
    return ratios, honest, chosen


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tagfield", default=str(ROOT / "build/release/bin/tagfield"))
    parser.add_argument("--tags", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--method", default="auto")
    parser.add_argument("--pose-sigma", type=float)
    parser.add_argument("--conditions", default="")
    parser.add_argument("--write", type=pathlib.Path, metavar="DIR")
    options = parser.parse_args()
    wanted = [word for word in options.conditions.split(",") if word]
    chosen = [(way, name) for way in WAYS for name in CONDITIONS
              if not wanted or f"{way} {name}" in wanted]
    if options.write:
        write_suite([write(way, name, options) for way, name in chosen], options)
        return 0
    for way, name in chosen:
        ratios, honest, method = run(options.tagfield, way, name, options)
        wrong = sum(value > 5 for value in honest)
        print(f"{f'{way} {name}':<34} {method:<6} {len(ratios):>3} of {options.tags:<3} "
              f"{rms(ratios):6.2f} x the bound, error/expected {rms(honest):5.2f}, "
              f"over 5 times {wrong}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
