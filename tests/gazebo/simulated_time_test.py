#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Reads depend on simulated time only: equal motion gives equal reads at any simulation speed."""

from gazebo import (
    RATE_HZ, Run, antenna, case, check, check_equal, check_near, main, messages, nanoseconds,
    recorded_in, schedule, tag, world)

SECONDS = 4.0
# Two tags on given paths, a static one, a fixed antenna and a moving one.
MODELS = (antenna("gate", 0, 0, 2, "<range>6</range><communication_gain>3</communication_gain>"),
          antenna("cart", -3, 1, 1, "<range>6</range><seed>7</seed>", static=False),
          tag("rest", 2, 1, 1), tag("slow", -4, 2, 1, static=False),
          tag("fast", 1, -9, 1, static=False))
MOTIONS = ('<move time="0" model="slow" velocity="0.5 0 0"/>'
           '<move time="0" model="fast" velocity="0 4 0"/>'
           '<move time="0" model="cart" velocity="0.3 0.1 0"/>')


def reads_at(context, factor):
    """All reads of the world at a multiple of real time, without the messages' sequence numbers, and the
    wall time [s] in which they arrived."""
    name = f"factor_{factor}"
    (context.folder / name).mkdir()
    log = context.folder / name / "schedule.log"
    with Run(context, world(*MODELS, schedule(log, MOTIONS, stop=SECONDS), factor=factor),
             name=name, record=True) as running:
        running.finish(log)
        found = messages(running.bag, "/rfid/reads")
        took = recorded_in(running.bag)
    reads = sorted((nanoseconds(read.header.stamp), read.antenna, read.epc, read.phase, read.rssi,
                    read.frequency, read.reader, read.header.frame_id)
                   for message in found for read in message.reads)
    return reads, took


@case
def real_time_slowed_down_and_free_running_give_the_same_reads(context):
    real, _ = reads_at(context, 1.0)
    check({read[2] for read in real} == {"rest", "slow", "fast"}, "a tag was never read")
    check(len(real) > 150, f"only {len(real)} reads")
    for factor in (0.5, 0.0):
        other, took = reads_at(context, factor)
        if factor > 0.0:
            check(took > 0.95 * SECONDS / factor, f"slowed down to {factor} it took {took:.1f} s")
        else:
            check(took < SECONDS, f"running free it took {took:.1f} s")
        check_equal(len(other), len(real), f"number of reads at {factor}")
        check(other == real, f"reads at {factor} times real time are not those at 1")


@case
def stamps_are_the_updates_times_on_the_steps_of_physics(context):
    reads, _ = reads_at(context, 0.0)
    stamps = sorted({read[0] for read in reads if read[1] == "gate"})
    # At the first step after n/15 s, and so within 1 ms.
    for number, stamp in enumerate(stamps):
        check_near(stamp * 1e-9, number / RATE_HZ + 0.0005, 0.00051 if number else 0.00052,
                   f"stamp {number}")
    # The step in which the schedule stops the world is completed.
    check_equal(len(stamps), int(SECONDS * RATE_HZ) + 1, "updates")


if __name__ == "__main__":
    main()
