#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tags and antennas come and go while Gazebo runs."""

import bisect

from gazebo import (
    Run, antenna, antenna_sensor, case, check, check_equal, insert, main, messages, model,
    nanoseconds, read_if_there, remove, schedule, tag, tag_sensor, world)

UPDATE_NS = 66_700_000  # One update at 15 Hz, on steps of 1 ms.


def presence(log):
    """Times of insertion and deletion [ns] of each model, as logged by the test's plugin."""
    spans = {}
    for line in read_if_there(log).splitlines():
        stamp, what, *name = line.split()
        if what == "+":
            spans.setdefault(name[0], []).append([int(stamp), None])
        elif what == "-":
            spans[name[0]][-1][1] = int(stamp)
    return spans


def check_reads_follow(found, spans, tags):
    """Checks that each update reads all tags that have existed for one update period, and none that was
    deleted an update period ago."""
    for message in found:
        stamp = nanoseconds(message.header.stamp)
        read = {one.epc for one in message.reads}
        check_equal(len(read), len(message.reads), f"tags read twice at {stamp}")
        for name in tags:
            came, went = spans[name][-1]
            if came + UPDATE_NS <= stamp and (went is None or stamp < went):
                check(name in read, f"{name} came at {came} and is not read at {stamp}")
            if stamp < came or (went is not None and went + UPDATE_NS <= stamp):
                check(name not in read, f"{name} went at {went} and is read at {stamp}")


@case
def a_hundred_tags_come_and_fifty_go(context):
    names = [f"tag{i}" for i in range(100)]
    inserts = "".join(insert(1.0 + 0.01 * i, tag(name, i % 10, i // 10, 1))
                      for i, name in enumerate(names))
    removes = "".join(remove(6.0 + 0.01 * i, name) for i, name in enumerate(names[::2]))
    log = context.folder / "schedule.log"
    text = world(antenna("gate", 5, 5, 3), schedule(log, inserts + removes, stop=9.0))
    with Run(context, text, record=True) as running:
        running.finish(log, 200.0)
        found = messages(running.bag, "/rfid/reads")
        truth = messages(running.bag, "/rfid/truth/tags")
        check(running.is_alive(), "Gazebo has ended")
    spans = presence(log)
    check(set(names) <= set(spans), f"only {len(spans)} models came")
    check_equal(sum(spans[name][-1][1] is not None for name in names), 50, "models that went")
    check_equal({one.epc for one in found[-1].reads}, set(names[1::2]), "tags read at the end")
    check_equal({one.epc for one in truth[-1].tags}, set(names[1::2]), "true tags at the end")
    check_reads_follow(found, spans, names)


@case
def an_antenna_goes_with_its_model_and_another_comes(context):
    cart = model("cart", "0 0 1 0 0 0",
                 antenna_sensor("reader", "<range>1000</range>") + tag_sensor("own_tag"),
                 static=False)
    log = context.folder / "schedule.log"
    text = world(cart, tag("shelf", 2, 0, 1),
                 schedule(log, remove(2.0, "cart")
                          + insert(4.0, antenna("gate", 0, 0, 3, "<range>1000</range>"))
                          + insert(5.0, cart), stop=7.0))
    with Run(context, text, record=True) as running:
        running.finish(log)
        found = messages(running.bag, "/rfid/reads")
        check(running.is_alive(), "Gazebo has ended")
    spans = presence(log)
    by_antenna = {}
    for message in found:
        by_antenna.setdefault(message.antenna, []).append(
            (nanoseconds(message.header.stamp), sorted(one.epc for one in message.reads)))
    check_equal(set(by_antenna), {"reader", "gate"}, "antennas")
    stamps = [stamp for stamp, _ in by_antenna["reader"]]
    (_, went), (came_again, _) = spans["cart"]
    between = stamps[bisect.bisect(stamps, went + UPDATE_NS):bisect.bisect_left(stamps, came_again)]
    check_equal(between, [], "reads of an antenna that went")
    check(stamps[0] < UPDATE_NS and stamps[-1] > came_again, "the cart does not read while there")
    gate = dict(by_antenna["gate"])
    check(min(gate) >= spans["gate"][0][0], "the gate reads before it comes")
    check_equal(gate[min(gate)], ["shelf"], "tags at first at the gate")
    check_equal(gate[max(gate)], ["cart", "shelf"], "tags at last at the gate")


@case
def a_reset_of_the_world_begins_the_same_reads_again(context):
    log = context.folder / "schedule.log"
    text = world(antenna("gate", 0, 0, 2), tag("rest", 2, 1, 1),
                 schedule(log, '<reset time="2"/>', stop=3.0))
    with Run(context, text, record=True) as running:
        running.finish(log)
        found = messages(running.bag, "/rfid/reads")
    reads = {}
    for message in found:
        reads.setdefault(nanoseconds(message.header.stamp), []).append(
            [(one.epc, one.phase, one.rssi) for one in message.reads])
    # Without the first updates, which are at the step at which the antenna starts or is reset.
    twice = [both for stamp, both in reads.items() if 10_000_000 < stamp < 1_900_000_000]
    check_equal({len(both) for both in twice}, {2}, "updates at one stamp")
    check(all(both[0] == both[1] for both in twice), "reads at one stamp differ")
    check(len(twice) >= 28, f"only {len(twice)} updates")


@case
def a_set_of_tags_is_one_model_with_a_table(context):
    rows = "".join(f'<tag epc="E{i:04d}">{0.1 * (i % 50)} {0.1 * (i // 50)} 0.5</tag>'
                   for i in range(500))
    table = context.folder / "more.csv"
    table.write_text("epc,x_m,y_m,z_m\nF1,1,2,3\nF2,-1,-2,3\n", encoding="utf-8")
    shelf = (f'<model name="shelf"><static>true</static><pose>1 1 0 0 0 1.5707963267948966</pose>'
             f'<link name="link"/><plugin name="tags" filename="libTagfieldTagSetPlugin.so">{rows}'
             f'<table>file://{table}</table></plugin></model>')
    log = context.folder / "schedule.log"
    with Run(context, world(antenna("gate", 0, 0, 2), shelf,
                            schedule(log, remove(1.0, "shelf"), stop=2.0)),
             record=True) as running:
        running.finish(log)
        found = messages(running.bag, "/rfid/reads")
        truth = messages(running.bag, "/rfid/truth/tags")
    places = {one.epc: one.position for one in truth[0].tags}
    check_equal(len(places), 502, "tags of the set")
    check_equal(len(found[0].reads), 502, "tags read")
    check_equal(found[-1].reads, [], "tags read when the set has gone")
    # A rotation by 90° at (1, 1) moves E0049 at (4.9, 0) to (1, 5.9) and F1 at (1, 2) to (-1, 2).
    for epc, (x, y, z) in {"E0049": (1.0, 5.9, 0.5), "F1": (-1.0, 2.0, 3.0)}.items():
        place = places[epc]
        check(max(abs(place.x - x), abs(place.y - y), abs(place.z - z)) < 1e-9, f"place of {epc}")


if __name__ == "__main__":
    main()
