#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Physical models in Gazebo, with Gazebo's geometry, give the same reads as the headless simulator."""

from gazebo import (
    Run, case, check, check_equal, check_in, check_near, insert, main, remove, schedule)
from hall import SECONDS, box, headless, reads_in, scenario, solid

def in_gazebo(context, path, events="", pace=0):
    """Runs the scenario in Gazebo with a moving cart and a moving tag; returns the folder of the located
    run, Gazebo's output, and the schedule's log."""
    world = context.folder / f"{path.stem}.world"
    context.run_well("gazebo", path, "--out", world, "--real-time", pace)
    folder = context.folder / path.stem
    log = context.folder / f"{path.stem}.log"
    motions = ('<move time="0" model="cart" velocity="0.6 -0.15 0"/>'
               '<move time="1" model="mover" velocity="0.8 -0.4 0.1"/>')
    text = world.read_text(encoding="utf-8").replace(
        "</world>", schedule(log, motions + events, stop=SECONDS) + "</world>")
    with Run(context, text, name=path.stem, record=True) as running:
        running.finish(log)
        said = running.log()
    ours = [line for line in said.split("\n") if "[Err]" in line and "plugin" in line]
    check_equal(ours, [], "the plugins' errors")
    context.run_well("localize", folder / "run.bag", "--scenario", path, "--out",
                     folder / "located")
    return folder / "located", said, log.read_text(encoding="utf-8")


def check_parity(context, model, settings, least):
    path = scenario(context, model, settings)
    run, _, _ = in_gazebo(context, path)
    expected = reads_in(run)
    actual = reads_in(headless(context, path, run))
    check(len(expected) >= least, f"only {len(expected)} reads")
    check_equal({read[2] for read in expected}, {"gate", "cart"}, "antennas that read")
    check("mover" in {read[3] for read in expected}, "the tag that moves was never read")
    odd = sorted(set(expected) ^ set(actual))
    check(len(actual) == len(expected),
          f"{len(actual)} reads in the replay, {len(expected)} in Gazebo; in one alone: {odd[:3]}")
    differing = [pair for pair in zip(expected, actual) if pair[0] != pair[1]]
    check(not differing, f"{len(differing)} of {len(expected)} reads differ, as {differing[:2]}")
    return expected


@case
def the_link_budget_is_the_same(context):
    check_parity(context, "link_budget", "channel_plan: etsi_low", 500)


@case
def multipath_of_order_two_is_the_same(context):
    reads = check_parity(context, "multipath", "reflection_order: 2, channel_plan: fcc", 500)
    check(len({read[4] for read in reads}) > 5, "the carriers don't hop")


INVENTORY = "inventory: gen2, session: s0, target: alternate, port_dwell_s: 0.3"


@case
def the_link_budget_with_inventory_is_the_same(context):
    reads = check_parity(context, "link_budget", INVENTORY, 300)
    check(len({read[0] for read in reads}) == len(reads), "reads of an inventory share stamps")


@case
def multipath_with_inventory_is_the_same(context):
    check_parity(context, "multipath", f"{INVENTORY}, encoding: miller4, diffuse_k_db: 8", 300)


@case
def without_noise_and_steps_the_waves_are_the_same(context):
    path = scenario(context, "multipath", "without: [noise, quantization, pi_ambiguity]")
    run, _, _ = in_gazebo(context, path)
    expected = reads_in(run)
    actual = reads_in(headless(context, path, run))
    check(len(expected) > 500, f"only {len(expected)} reads")
    odd = sorted(set(expected) ^ set(actual))
    check(len(actual) == len(expected),
          f"{len(actual)} reads in the replay, {len(expected)} in Gazebo; in one alone: {odd[:3]}")
    for one, other in zip(expected, actual):
        check_equal(other[:5], one[:5], "stamp, antenna, tag and carrier")
        check_near(float(other[5]), float(one[5]), 1e-6, f"phase of {one}")
        check_near(float(other[6]), float(one[6]), 1e-6, f"power of {one}")


def seconds_of(events, log):
    """Time [s] of an event in the schedule's log."""
    return [int(line.split()[0]) * 1e-9 for line in log.split("\n") if line.endswith(events)][0]


@case
def models_that_come_and_go_shade_the_tags(context):
    """A metal screen at the gate for a second shades the tags; a movable model does not."""
    screen = solid("metal_screen", "-3.8 -1 2.2 0 0 0", ("0 0 0 0 0 0", box(0.02, 8, 8)))
    loose = solid("loose", "-3.7 -1 2.2 0 0 0", ("0 0 0 0 0 0", box(0.02, 3, 3)))
    loose = loose.replace("<static>1</static>", "")
    path = scenario(context, "link_budget", "channel_plan: etsi_low")
    events = insert(1, loose) + insert(2, screen) + remove(3, "metal_screen")
    # Gazebo inserts and deletes models ten times per second of wall time.
    run, said, log = in_gazebo(context, path, events, pace=1)
    stamps = [float(read[0]) for read in reads_in(run) if read[2] == "gate"]
    comes, goes = seconds_of("+ metal_screen", log), seconds_of("- metal_screen", log)
    check(seconds_of("+ loose", log) < comes - 0.2 < goes - 0.4 < SECONDS - 0.6, log)
    for begin, end, is_open in ((0, comes, True), (comes, goes, False), (goes, SECONDS, True)):
        found = [stamp for stamp in stamps if begin < stamp < end]
        check(bool(found) == is_open, f"{len(found)} reads from {begin} s to {end} s")
    check_in("materials are guessed from names", said, "the log")


if __name__ == "__main__":
    main()
