#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Spawns and deletes thousands of tags and antennas in the real gzserver, each with its own plugin instance: it does
not crash, and its memory grows no more than with as many models without sensors.

    spawn_campaign.py --plugins build/gazebo/lib --tagfield … --source … --build …   like the tests in Gazebo

TAGFIELD_SPAWNS is the number of tags (default 10,000), 2,000 per gzserver, plus 2,000 models without sensors for
comparison. There are a tenth as many antennas.
No gzserver survives ten thousand models of any kind: Gazebo 11 keeps the collision spaces of deleted models, each step
searches for collisions among all of them, and after some 7,200 models ODE's stack overflows in that search.
"""

import math
import os
import pathlib

from gazebo import (
    Run, antenna, case, check, check_between, check_equal, insert, main, model, read_if_there, remove, schedule, tag, world)

COUNT = int(os.environ.get("TAGFIELD_SPAWNS", "10000"))
OF_A_SERVER = min(COUNT, 2000)
EACH_S = 0.02  # time between two insertions: one step
LIFE_S = 0.5


def server_memory(world_file):
    """Resident memory [MB] of the gzserver with this world; None if it no longer runs."""
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            if words[0].endswith(b"gzserver") and world_file.encode() in words:
                return int((folder / "statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
        except OSError:
            pass
    return None


def went(log):
    return sum(1 for line in read_if_there(log).splitlines() if line.split()[1] == "-")


def growth(context, name, of_name, others, count=OF_A_SERVER):
    """Memory [kB] that each deleted model leaves behind in one server; models are `of_name(NAME, X, Y)`, and `others`
    stay."""
    events = "".join(insert(1.0 + EACH_S * i, of_name(f"{name}_{i}", i % 10, i // 10 % 10))
                     + remove(1.0 + EACH_S * i + LIFE_S, f"{name}_{i}") for i in range(count))
    log = context.folder / f"{name}.log"
    text = world(others, schedule(log, events, stop=1.0 + EACH_S * count + 2.0), step_s=EACH_S)
    memory = []
    with Run(context, text, name=name, master=False) as running:
        for share in (0.2, 0.4, 0.6, 0.8, 1.0):
            running.wait_for(f"{share:.0%} of the models", lambda s=share: went(log) >= s * count, 7200.0)
            memory.append(server_memory(str(running.world)))
            check(memory[-1] is not None, f"Gazebo has ended after {went(log)} models")
            print(f"{name}: {went(log)} went, {memory[-1]:.1f} MB", flush=True)
        running.wait_for("the end", lambda: "stopped" in read_if_there(log), 600.0)
        check(running.is_alive(), "Gazebo has ended")
    check_equal(went(log), count, "models that went")
    return (memory[-1] - memory[0]) * 1000 / (0.8 * count)


def check_growth(with_sensors, without, what):
    """Compares memory growth with and without sensors, as Gazebo itself leaks some memory for each."""
    print(f"each leaves {with_sensors:.2f} kB behind, and {without:.2f} kB without a sensor", flush=True)
    check_between(with_sensors - without, -10.0, 10.0, f"growth by {what} [kB each]")


def bare(name, x, y):
    return model(name, f"{x} {y} 1 0 0 0", "")


@case
def tags_come_and_go_by_the_thousand(context):
    gate = antenna("gate", 5, 5, 3)
    without = growth(context, "models", bare, gate)
    for server in range(math.ceil(COUNT / OF_A_SERVER)):
        check_growth(growth(context, f"tags{server}", lambda name, x, y: tag(name, x, y, 1), gate), without, "tags")


@case
def antennas_come_and_go_by_the_hundred(context):
    count = max(COUNT // 10, 100)
    shelf = "".join(tag(f"tag{i}", i, 5, 1) for i in range(10))
    without = growth(context, "models", bare, shelf, count)
    check_growth(growth(context, "antennas", lambda name, x, y: antenna(name, x, y, 3), shelf, count), without, "antennas")


if __name__ == "__main__":
    main()
