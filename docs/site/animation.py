#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the README's animation: the warehouse experiment, localized again as the reads arrive.

    scripts/setup --python && cmake --build build/release --target tagfield_python
    PYTHONPATH=build/release/lib/python docs/site/animation.py docs/images/experiment.webp
"""

import io
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import tagfield  # noqa: E402
from PIL import Image  # noqa: E402

FRAMES = 60
HOLD = 15  # number of times that the last frame is repeated
MILLISECONDS = 110
BLUE, ORANGE, GREY, BLACK = "#0072b2", "#d55e00", "#9a9a9a", "#222222"


def estimates_by(run, heights_m, end_s):
    """Positions (2,) and errors [m] of the tags that can be located from the reads up to a time."""
    reads = run.reads[run.reads.time_s <= end_s]
    if len(reads) < 30:
        return {}
    found = tagfield.localize(reads, run.poses, "ml", tag_heights_m=heights_m, pose_sigma_m=0,
                              max_expected_error_m=0.5)
    rows = zip(found.estimates.names("tag"), found.estimates["position_m"], found.located, strict=True)
    return {tag: place[:2] for tag, place, located in rows if located}


def draw(run, truth, history, times, number, recent):
    figure, (hall, errors) = plt.subplots(1, 2, figsize=(9.6, 5.0), dpi=80, width_ratios=(1.0, 1.15))
    tagfield.plot.world(run.scenario, hall)
    path = run.poses["position_m"][run.poses.time_s <= times[number]]
    hall.plot(path[:, 0], path[:, 1], color=BLUE, linewidth=1.6)
    here = path[-1]
    for tag, place in truth.items():
        is_read = tag in recent
        if is_read:
            hall.plot([here[0], place[0]], [here[1], place[1]], color=BLUE, linewidth=0.7, alpha=0.45)
        hall.plot(*place[:2], "o", markersize=8, markerfacecolor=BLUE if is_read else "white",
                  markeredgecolor=BLACK)
    for tag, place in history[number].items():
        hall.plot(*place, "+", color=ORANGE, markersize=12, markeredgewidth=2.2)
    hall.plot(*here[:2], "s", color=BLUE, markersize=9)
    hall.set_aspect("equal")
    hall.set_xlabel("x [m]")
    hall.set_ylabel("y [m]")
    hall.set_title(f"{times[number]:4.1f} s, {int((run.reads.time_s <= times[number]).sum())} reads", fontsize=11)

    for tag, place in truth.items():
        seen = [(times[i], 1e3 * np.hypot(*(history[i][tag] - place[:2])))
                for i in range(number + 1) if tag in history[i]]
        if seen:
            when, error_mm = np.array(seen).T
            errors.plot(when, np.maximum(error_mm, 0.1), color=ORANGE, linewidth=1.1, alpha=0.8)
            errors.plot(when[-1], max(error_mm[-1], 0.1), "o", color=ORANGE, markersize=4)
    errors.set_yscale("log")
    errors.set_xlim(0, times[-1])
    errors.set_ylim(0.1, 1000)
    errors.set_yticks([0.1, 1, 10, 100, 1000], ["0.1 mm", "1 mm", "1 cm", "10 cm", "1 m"])
    errors.grid(color="#dddddd", linewidth=0.6)
    errors.set_xlabel("time [s]")
    errors.set_title(f"error of each tag: {len(history[number])} of {len(truth)} located", fontsize=11)
    figure.tight_layout()
    file = io.BytesIO()
    figure.savefig(file, format="png")
    plt.close(figure)
    return Image.open(file).convert("RGB")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    run = tagfield.load(tagfield.share("scenarios/paper_warehouse.yaml")).run(seed=1)
    truth = run.truth.positions_m()
    heights_m = {tag: place[2] for tag, place in truth.items()}
    times = np.linspace(0, run.reads.time_s[-1], FRAMES + 1)[1:]
    history = [estimates_by(run, heights_m, end_s) for end_s in times]
    frames = []
    for number, end_s in enumerate(times):
        near = (run.reads.time_s <= end_s) & (run.reads.time_s > end_s - 0.5)
        recent = set(run.reads[near].names("tag"))
        frames.append(draw(run, truth, history, times, number, recent))
    frames += [frames[-1]] * HOLD
    target = pathlib.Path(sys.argv[1])
    frames[0].save(target, save_all=True, append_images=frames[1:], duration=MILLISECONDS, loop=0, quality=60,
                   method=6)
    print(f"{target}: {len(frames)} frames, {target.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
