#!/usr/bin/python3
"""Locates the tags of public measurements with one command an experiment, and judges by their truth.

    benchmarks/real_data.py [--tagfield build/release/bin/tagfield] [--data ../shared/data/real]
                            [--methods auto,sar] [--side=+y]

Prints for each experiment of AdaRF and each method how many tags got a place, the median and 95 % of
their errors, and the root mean square of error over expected error. Says so, and ends well, where the
data are not there. Needs the programs tar and zstd.
"""

import argparse
import csv
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def truth_of(data):
    """Places by experiment and tag: along the rail and away from it [m]."""
    places = {}
    with open(data / "adarf/truth.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            places.setdefault(row["experiment"], {})[row["tag"]] = (
                float(row["x_m"]), float(row["range_m"]))
    return places


def unpacked(archive, folder):
    """The folder with the experiment's tables."""
    subprocess.run(["tar", "--zstd", "-xf", archive, "-C", folder], check=True)
    return next(path.parent for path in pathlib.Path(folder).rglob("*.csv"))


def located(program, experiment, out, arguments):
    """Best candidates of located tags by ID: x, y and the expected error; and the rail's y."""
    subprocess.run([program, "localize", experiment, "--format", "adarf", "--out", out, *arguments],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(pathlib.Path(out) / "antenna_poses.csv", encoding="utf-8") as file:
        rail = float(next(csv.DictReader(file))["y_m"])
    places = {}
    with open(pathlib.Path(out) / "estimates.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["verdict"] == "located":
                places[row["tag"]] = (float(row["x_m"]), float(row["y_m"]),
                                      float(row["expected_error_m"]))
    return places, rail


def judged(places, rail, truth):
    """Error and expected error of each tag with a place and a truth."""
    return [(math.hypot(x - truth[tag][0], abs(y - rail) - truth[tag][1]), expected)
            for tag, (x, y, expected) in places.items() if tag in truth]


def line_of(name, outcomes, tags):
    if not outcomes:
        return f"{name:<28} {0:>3} of {tags:<3}"
    errors = sorted(error for error, _ in outcomes)
    p95 = errors[min(len(errors) - 1, math.ceil(0.95 * len(errors)) - 1)]
    ratio = math.sqrt(statistics.fmean((error / expected) ** 2 for error, expected in outcomes))
    wrong = sum(error > 5 * expected for error, expected in outcomes)
    return (f"{name:<28} {len(outcomes):>3} of {tags:<3} median {1e3 * statistics.median(errors):4.0f}"
            f" mm, 95 % {1e3 * p95:4.0f}, error/expected {ratio:5.2f}, over 5 times {wrong}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tagfield", default=str(ROOT / "build/release/bin/tagfield"))
    parser.add_argument("--data", type=pathlib.Path, default=ROOT.parent / "shared/data/real")
    parser.add_argument("--methods", default="auto")
    parser.add_argument("--side", default="+y")
    parser.add_argument("--box", nargs=4)
    options = parser.parse_args()
    if not (options.data / "adarf").is_dir():
        print(f"skipped: there are no measurements in {options.data}")
        return 0
    area = [f"--side={options.side}"] + (["--box", *options.box] if options.box else [])
    truth = truth_of(options.data)
    for method in options.methods.split(","):
        everything, tags = [], 0
        for name, places in sorted(truth.items()):
            with tempfile.TemporaryDirectory() as folder:
                experiment = unpacked(options.data / f"adarf/{name}.tar.zst", folder)
                found, rail = located(options.tagfield, experiment, f"{folder}/out",
                                      ["--method", method, *area])
            outcomes = judged(found, rail, places)
            print(line_of(f"{method} {name}", outcomes, len(places)), flush=True)
            everything += outcomes
            tags += len(places)
        print(line_of(f"{method} all", everything, tags), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
