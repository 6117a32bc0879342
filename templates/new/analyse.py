#!/usr/bin/env python3
"""Runs the scenario with several seeds and plots estimated tag positions and their errors.

    python3 analyse.py [SEEDS]

Needs the Python package `tagfield` (python3-tagfield, or docs/python.md) with NumPy and matplotlib.
"""

import pathlib
import sys

import matplotlib
import numpy

matplotlib.use("Agg")  # writes figures to files; remove this line and call show() for windows
import tagfield

HERE = pathlib.Path(__file__).resolve().parent


def main():
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    scenario = tagfield.load(HERE / "NAME.yaml")
    # Like --set on the command line: a pose error of 1 cm.
    scenario = scenario.with_({"pose.source": "noisy", "pose.sigma_m": 0.01})
    runs = scenario.run_many(seeds)

    # Reads are a NumPy array: one row per read, columns by name.
    reads = runs[0].reads
    for index, tag in enumerate(reads.categories["tag"]):
        rssi_dbm = reads["rssi_dbm"][reads["tag"] == index]
        print(f"{tag}: {len(rssi_dbm)} reads, {numpy.median(rssi_dbm):.1f} dBm in the median")

    errors_m = numpy.concatenate([run.errors_m for run in runs])
    print(f"{seeds} seeds: {1e3 * numpy.mean(errors_m):.1f} mm off in the mean, "
          f"{1e3 * numpy.quantile(errors_m, 0.95):.1f} mm at 95 %")

    tagfield.plot.hall(runs[0]).figure.savefig(HERE / "hall.png", dpi=150)
    tagfield.plot.errors({"auto": runs}).figure.savefig(HERE / "errors.png", dpi=150)
    print(f"figures: {HERE / 'hall.png'}, {HERE / 'errors.png'}")


if __name__ == "__main__":
    main()
