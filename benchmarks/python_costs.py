#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Cost of the Python package: reads to NumPy, one link, a batch of links, seeds in parallel.

Prints CPU times, each the minimum of several; for seeds in parallel wall times.

    PYTHONPATH=build/release/lib/python benchmarks/python_costs.py [--reads N]
"""

import argparse
import os
import time

import numpy as np

import tagfield


def seconds(work, repeats=7):
    """The minimum CPU time of a call, in this thread."""
    times = []
    for _ in range(repeats):
        begin = time.thread_time()
        work()
        times.append(time.thread_time() - begin)
    return min(times)


def clock_seconds(work, repeats=3):
    """The minimum wall time of a call."""
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return min(times)


def many_reads(count):
    """A scenario with at least `count` reads: an antenna with the paper's model and a thousand tags."""
    places = np.random.default_rng(1).uniform([-5, -5, 0.5], [5, 5, 2], (1000, 3))
    return tagfield.Scenario(
        "reads", model="paper", duration_s=1.05 * count / 15 / 1000,
        antennas=[{"name": "a", "pose": [0, 0, 1], "range_m": 20, "rate_hz": 15}],
        tags=[{"id": f"E2801160{i:016X}", "position": place} for i, place in enumerate(places)])


def free_space(**keys):
    return tagfield.Scenario("link", model="link_budget", duration_s=1, **keys,
                             antennas=[{"name": "a", "pose": [0, 0, 1]}],
                             tags=[{"id": "t", "position": [2, 0, 1]}])


def tell(what, value, unit, limit=""):
    print(f"{what:54} {value:10.3f} {unit}{limit}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--reads", type=int, default=1_000_000)
    count = parser.parse_args().reads

    run = many_reads(count).run(locate=False)
    reads = run.reads
    sim = many_reads(count).simulation()
    while not sim.finished:
        sim._core.step(1000)  # Keeps all reads in C++, so that take() converts them at once.
    begin = time.thread_time()
    taken = sim._core.take()["reads"]
    handed_s = time.thread_time() - begin
    assert len(taken) == len(reads)
    tell(f"{len(taken)} reads handed to NumPy", 1e3 * handed_s, "ms", "   (limit 20 ms)")
    tell("the same as a float64 column", 1e3 * seconds(lambda: np.asarray(reads["phase_rad"])), "ms")
    tell("to_pandas()", 1e3 * seconds(reads.to_pandas, 3), "ms")

    link = free_space().link()
    loops = 100_000

    def one_by_one():
        for _ in range(loops):
            link(2.0, 0.5, 1.0)

    tell("one link", 1e6 * seconds(one_by_one, 3) / loops, "µs", "   (limit 2 µs)")
    places = np.random.default_rng(1).uniform([1, -3, 0.5], [6, 3, 2], (loops, 3))
    tell("a link of a batch, all effects", 1e9 * seconds(lambda: link.batch(places)) / loops, "ns")
    open_link = free_space(without=["occlusion"]).link()
    tell("a link of a batch, without occlusion", 1e9 * seconds(lambda: open_link.batch(places)) / loops, "ns")

    scenario = tagfield.load(tagfield.share("scenarios/paper_warehouse.yaml"))
    for threads in sorted({1, os.cpu_count() or 1}):
        tell(f"a seed of the warehouse experiment, {threads} threads",
             1e3 * clock_seconds(lambda: scenario.run_many(8, threads=threads)) / 8, "ms")


if __name__ == "__main__":
    main()
