#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Locates the tags of public datasets with one command per experiment, and compares with the ground truth.

    benchmarks/real_data.py [--tagfield build/release/bin/tagfield] [--data ../shared/data/real]
                            [--methods auto,sar] [--side=+y] [--calibration]

Prints for each experiment of AdaRF and each method the number of located tags, median, mean and 95th
percentile of their errors, and the root mean square of error over expected error; with --calibration
also with a calibration from all other experiments. Then the tags and walks of the portal dataset. If the
data are missing, it prints that and exits with 0. Needs the programs tar and zstd.
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
    """Positions by experiment and tag: along the rail and distance from it [m]."""
    places = {}
    with open(data / "adarf/truth.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            places.setdefault(row["experiment"], {})[row["tag"]] = (
                float(row["x_m"]), float(row["range_m"]))
    return places


def unpacked(archive, folder):
    """Unpacks an archive and returns the folder with the experiment's tables."""
    pathlib.Path(folder).mkdir()
    subprocess.run(["tar", "--zstd", "-xf", archive, "-C", folder], check=True)
    return next(path.parent for path in pathlib.Path(folder).rglob("*.csv"))


def located(program, experiment, out, arguments):
    """Positions (x, y) and expected errors of located tags by ID, and the rail's y."""
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
    """Error and expected error of each located tag with ground truth."""
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
            f", mean {1e3 * statistics.fmean(errors):4.0f}"
            f" mm, 95 % {1e3 * p95:4.0f}, error/expected {ratio:5.2f}, over 5 times {wrong}")


def rail_of(experiment):
    """The rail's y and z, which are arbitrary constants in the dataset."""
    with open(sorted(experiment.glob("*.csv"))[0], encoding="utf-8-sig") as file:
        row = next(csv.DictReader(file))
    return float(row["y"]), float(row["z"])


def calibrated_by_others(program, name, experiments, truth, folder):
    """The calibration profile from all other experiments, or None if the calibration fails."""
    arguments = []
    for other, path in experiments.items():
        if other == name:
            continue
        y, z = rail_of(path)
        tags = pathlib.Path(folder) / f"{other}.csv"
        tags.write_text("tag,x_m,y_m,z_m\n" + "".join(
            f"{tag},{x},{y + away},{z}\n" for tag, (x, away) in truth[other].items()),
            encoding="utf-8")
        arguments += [path, "--tags", tags]
    profile = pathlib.Path(folder) / "profile.yaml"
    result = subprocess.run([program, "calibrate", *arguments, "--format", "adarf", "--out", profile],
                            capture_output=True, text=True, check=False)
    return profile if result.returncode == 0 else None


def adarf(options, truth):
    area = [f"--side={options.side}"] + (["--box", *options.box] if options.box else [])
    with tempfile.TemporaryDirectory() as folder:
        experiments = {name: unpacked(options.data / f"adarf/{name}.tar.zst", f"{folder}/{name}")
                       for name in sorted(truth)}
        for method in options.methods.split(","):
            for calibrate in ((False, True) if options.calibration else (False,)):
                everything, tags = [], 0
                for name, experiment in experiments.items():
                    how = ["--method", method, *area]
                    if calibrate:
                        profile = calibrated_by_others(options.tagfield, name, experiments, truth,
                                                       folder)
                        how += ["--calibration", profile] if profile else []
                    found, rail = located(options.tagfield, experiment, f"{folder}/out", how)
                    outcomes = judged(found, rail, truth[name])
                    label = f"{method} {name}{' calibrated' if calibrate else ''}"
                    print(line_of(label, outcomes, len(truth[name])), flush=True)
                    everything += outcomes
                    tags += len(truth[name])
                label = f"{method} all{' calibrated' if calibrate else ''}"
                print(line_of(label, everything, tags), flush=True)


def portal(options):
    """Evaluates the static tags of a portal with four antennas, and the walks through it."""
    folder_of_data = options.data / "portal"
    if not folder_of_data.is_dir():
        return
    with open(folder_of_data / "static_truth.csv", encoding="utf-8") as file:
        truth = {row["tag"]: (float(row["x_m"]), float(row["y_m"])) for row in csv.DictReader(file)}
    poses = ["--poses", folder_of_data / "antenna_poses.csv", "--format", "llrp_fcc"]
    with tempfile.TemporaryDirectory() as folder:
        reads = pathlib.Path(folder) / "static_log.csv"
        subprocess.run(["zstd", "-dq", folder_of_data / "static_log.csv.zst", "-o", reads], check=True)
        for name, area in (("room known", ["--box", "0", "0", "4.572", "4.572"]), ("no area", [])):
            subprocess.run([options.tagfield, "localize", reads, *poses, "--tag-height", "0.9", *area,
                            "--out", f"{folder}/out"], check=True, capture_output=True)
            with open(f"{folder}/out/estimates.csv", encoding="utf-8") as file:
                outcomes = [(math.dist((float(row["x_m"]), float(row["y_m"])), truth[row["tag"]]),
                             float(row["expected_error_m"]))
                            for row in csv.DictReader(file) if row["verdict"] == "located"]
            print(line_of(f"portal, {name}", outcomes, len(truth)), flush=True)
        for walk in sorted(folder_of_data.glob("walks/Move*.csv")):
            subprocess.run([options.tagfield, "track", walk, *poses, "--tag-height", "1.2",
                            "--acceleration-noise", "0.3", "--out", f"{folder}/track"], check=True,
                           capture_output=True)
            with open(f"{folder}/track/verdicts.csv", encoding="utf-8") as file:
                for row in csv.DictReader(file):
                    print(f"portal {walk.stem:<21} {row['verdict']} {row['reason']}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tagfield", default=str(ROOT / "build/release/bin/tagfield"))
    parser.add_argument("--data", type=pathlib.Path, default=ROOT.parent / "shared/data/real")
    parser.add_argument("--methods", default="auto")
    parser.add_argument("--side", default="+y")
    parser.add_argument("--box", nargs=4)
    parser.add_argument("--calibration", action="store_true")
    options = parser.parse_args()
    if not (options.data / "adarf").is_dir():
        print(f"skipped: there are no measurements in {options.data}")
        return 0
    adarf(options, truth_of(options.data))
    portal(options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
