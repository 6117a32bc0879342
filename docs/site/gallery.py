# SPDX-License-Identifier: Apache-2.0
"""The gallery: figures from small scenarios that run while the site is built."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

# Title, description, command (DIR is its results folder), figures with captions.
PICTURES = [
    ("The warehouse experiment",
     "Ten tags are located from the phases that one antenna on a robot reads "
     "([the paper's model](paper_model.md), [localization](localization.md)).",
     "run scenarios/paper_warehouse.yaml --out DIR",
     [("figures/fig09_map.svg", "path of the antenna, true places (diamonds) and estimates (crosses)"),
      ("figures/fig12_phase_distance.svg", "unwrapped phase of one tag against its true distance"),
      ("figures/fig10_errors.svg", "error of each tag")]),
    ("A robot that maps the hall itself",
     "It maps by laser, localizes on its map and drives to its goals; its pose error is estimated with the tags "
     "([mapping](mapping.md), [estimators](estimators.md)).",
     "run scenarios/paper_warehouse_slam.yaml --out DIR",
     [("figures/fig06_robot_map.svg", "the occupancy grid and the path"),
      ("figures/pose_error.svg", "error of the pose that the robot believes")]),
    ("Where tags are read",
     "Read probability and margin of a tag in every cell, over all antennas ([coverage](coverage.md)).",
     "coverage scenarios/two_antennas.yaml --set model=link_budget --height 1 --step 0.2 --out DIR",
     [("figures/probability_1.00m.svg", "read probability at 1 m height"), ("figures/margin_1.00m.svg", "margin in dB")]),
    ("Antenna placement",
     "How many tags a fashion store's ceiling reads with one antenna, two, and so on ([plan](plan.md)).",
     "plan scenarios/plan/store.yaml --out DIR",
     [("figures/plan_curve.svg", "tags read over the number of antennas"),
      ("figures/plan_level_1.svg", "read probability of each place with the chosen layout")]),
    ("Tags on a conveyor",
     "Twelve parcels followed past two fixed antennas ([tracking](tracking.md)).",
     "track scenarios/conveyor.yaml --out DIR",
     [("tracks.svg", "tracks from above"), ("figures/passings.svg", "when each passed the gates and the line")]),
    ("Methods compared",
     "Errors of three methods with exact poses and with a pose error of 1 cm ([benchmarks](bench.md)).",
     "bench scenarios/bench/paper_warehouse.yaml --seeds 3 --methods hyperbola,ml,joint "
     "--conditions 'true pose,pose 1 cm' --out DIR",
     [("figures/ratio_to_bound.svg", "mean error over the Cramér-Rao bound"), ("figures/errors_1.svg", "distribution of errors")]),
]


def draw(top, tagfield, command, folder):
    """Runs one command in the source folder."""
    import shlex

    words = [word.replace("DIR", str(folder)) for word in shlex.split(command)]
    done = subprocess.run([tagfield, *words], cwd=top, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          encoding="utf-8")
    if done.returncode != 0:
        sys.exit(f"gallery: tagfield {command} failed:\n{done.stdout}")


def write_page(top, tagfield, folder, draw_pictures=True):
    written = ["# Gallery\n", "Drawn by Tagfield while this site was built, each by the command beside it.\n"]
    images = pathlib.Path(folder) / "images"
    for number, (title, text, command, figures) in enumerate(PICTURES, 1):
        written += [f"## {title}\n", f"{text}\n", f"```bash\ntagfield {command}\n```\n"]
        if not draw_pictures:
            continue
        with tempfile.TemporaryDirectory() as temporary:
            results = pathlib.Path(temporary) / "results"
            draw(top, tagfield, command, results)
            for name, caption in figures:
                picture = f"gallery_{number}_{pathlib.Path(name).name}"
                shutil.copyfile(results / name, images / picture)
                written.append(f"![{caption}](images/{picture})\n\n*{caption[0].upper()}{caption[1:]}.*\n")
    (pathlib.Path(folder) / "gallery.md").write_text("\n".join(written), encoding="utf-8")
