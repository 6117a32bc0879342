#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Coverage of the 95 % intervals that plans forecast, checked by full simulations of their layouts.

    benchmarks/plan_accuracy.py [--tagfield PROGRAM] [--cases N] [--first N] [--aim probability|reads|position]

Each case is a random hall: volumes of tags, mounts on the ceiling or the walls, number of antennas, session
and channel plan of the reader, duration, with or without diffuse fields or reflections. Each is planned, and
its layout is run once in full with other random tags, hops and slots. With --aim reads or position, the
counted tags are those with 2 to 20 reads, or those that can be located to within 0.1 to 2 m.
"""

import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SESSIONS = ("s0", "s1", "s2")
PLANS = ("etsi_low", "fcc")
TAGS = ("monza_r6", "monza_4", "higgs_3")


def tags_of(draw, number, room):
    length, width, _ = room
    x, y, z = draw.uniform(0.5, length - 2.0), draw.uniform(0.5, width - 2.0), draw.uniform(0.2, 1.2)
    box = [x, y, z, min(length, x + draw.uniform(0.5, 4.0)), min(width, y + draw.uniform(0.5, 3.0)),
           z + draw.uniform(0.3, 1.2)]
    turned = "any" if draw.random() < 0.6 else [[0, 0, draw.uniform(0.0, 6.28)]]
    return {"name": f"volume_{number}", "box": box, "spacing_m": draw.choice([0.4, 0.6, 0.9]),
            "orientations": turned, "profile": draw.choice(TAGS), "count": draw.choice([20, 60, 150])}


def scenario_of(case):
    """The random scenario of a case; it is written as JSON, which is valid YAML."""
    draw = random.Random(case)
    room = (draw.uniform(4.0, 12.0), draw.uniform(4.0, 9.0), draw.uniform(2.5, 5.0))
    reader = {"profiles": ["speedway_r420", "panel_6dbi"], "channel_plan": draw.choice(PLANS),
              "session": draw.choice(SESSIONS), "powers_dbm": [draw.choice([20, 24, 27, 29])]}
    reflects = draw.random() < 0.25
    if not reflects and draw.random() < 0.5:
        reader["diffuse_k_db"] = draw.choice([3.0, 8.0])
    ceiling = {"name": "ceiling", "surface": [[0.5, 0.5, room[2]], [room[0] - 0.5, 0.5, room[2]],
                                              [0.5, room[1] - 0.5, room[2]]],
               "spacing_m": draw.choice([1.5, 2.5]), "rpy_deg": [[0, 90, 0]], **reader}
    wall = {"name": "wall", "line": [[0.2, 0.5, 1.8], [0.2, room[1] - 0.5, 1.8]], "spacing_m": 1.5,
            "rpy_deg": [[0, 0, 0], [0, 30, 0]], **reader}
    ports = draw.choice([1, 2, 4])
    antennas = draw.randint(1, 6)
    scenario = {
        "name": f"case_{case}", "seed": case + 1, "duration_s": draw.choice([0.5, 1.5, 4.0]),
        "model": "multipath" if reflects else "link_budget",
        "plan": {"tags": [tags_of(draw, i, room) for i in range(draw.randint(1, 3))],
                 "mounts": draw.choice([[ceiling], [wall], [ceiling, wall]]),
                 "limits": {"antennas": antennas, "readers": antennas, "ports": ports}}}
    if reflects:
        scenario["world"] = {"path": str(ROOT / "worlds/portal_room.sdf"), "default_material": "plasterboard"}
        scenario["plan"]["mounts"] = [{"name": "corner", "points": [[0, 0, 1.2], [4.5, 4.5, 1.2], [0, 4.5, 1.2]],
                                       "rpy_deg": [[0, 0, draw.choice([30, 45, 60])], [0, 0, -135]], **reader}]
        for tags in scenario["plan"]["tags"]:
            low = [draw.uniform(0.5, 3.0), draw.uniform(0.5, 3.0), draw.uniform(0.3, 1.2)]
            tags["box"] = low + [low[0] + 1.2, low[1] + 1.2, low[2] + 0.5]
    return scenario


def aim_of(case, kind):
    draw = random.Random(1_000_000 + case)
    if kind == "reads":
        return {"dwell_reads": draw.choice([2, 5, 10, 20])}
    return {"position_error_m": draw.choice([0.1, 0.3, 1.0, 2.0])}


def checked(program, case, aim, folder):
    path = folder / f"case_{case}.yaml"
    scenario = scenario_of(case)
    if aim != "probability":
        scenario["plan"]["aim"] = aim_of(case, aim)
    path.write_text(json.dumps(scenario), encoding="utf-8")
    out = folder / f"out_{case}"
    result = subprocess.run([program, "plan", path, "--check", "1", "--no-links", "--out", out],
                            capture_output=True, text=True, check=False)
    if result.returncode != 0:
        if "reaches any tag" in result.stderr:
            return None
        sys.exit(f"case {case}: {result.stderr}")
    plan = json.loads((out / "plan.json").read_text(encoding="utf-8"))
    layout = next(one for one in plan["layouts"] if len(one["antennas"]) == plan["chosen_antennas"])
    read = plan["check"]["read"][0]
    return {"tags": plan["tags"], "read": read, **layout["read"],
            "inside": layout["read"]["low"] <= read <= layout["read"]["high"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--tagfield", default=ROOT / "build/release/bin/tagfield")
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--aim", choices=("probability", "reads", "position"), default="probability")
    arguments = parser.parse_args()
    inside = made = 0
    off = []
    width = []
    case = arguments.first
    with tempfile.TemporaryDirectory() as folder:
        while made < arguments.cases:
            found = checked(arguments.tagfield, case, arguments.aim, pathlib.Path(folder))
            if found is not None:
                made += 1
                inside += found["inside"]
                off.append((found["read"] - found["mean"]) / found["tags"])
                width.append((found["high"] - found["low"]) / found["tags"])
                if not found["inside"]:
                    print(f"case {case}: {found['read']:g} of {found['tags']} read, "
                          f"{found['low']:.1f} to {found['high']:.1f} stated")
            case += 1
    off.sort()
    print(f"{inside} of {made} within the stated range ({100.0 * inside / made:.1f} %)")
    print(f"read less forecast, of the tags: mean {100.0 * sum(off) / made:+.2f} %, "
          f"middle nine tenths {100.0 * off[made // 20]:+.1f} to {100.0 * off[-1 - made // 20]:+.1f} %")
    print(f"width of the range, of the tags: mean {100.0 * sum(width) / made:.1f} %")


if __name__ == "__main__":
    main()
