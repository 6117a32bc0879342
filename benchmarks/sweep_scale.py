#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Load of a sweep's nodes on a shared file system, modelled as queues and simulated.

    benchmarks/sweep_scale.py [--runs 1000000] [--run-s 0.3] [--metadata-per-s 10000]
                              [--writes-per-s 5000] [--start-s 0.3] [--save-every-s 5]
    benchmarks/sweep_scale.py --merge LOGS [--runs-each 10] [--tagfield build/release/bin/tagfield]
    benchmarks/sweep_scale.py --efficiency SEEDS [--tagfield build/release/bin/tagfield]

Without --merge: a queue of metadata operations and one of small synchronous writes, each served at a
constant rate, and N nodes that start within a second, do their share of the runs and end. For three ways
to store results (one file per run; each result appended at once, with all logs read at the start; as
`tagfield sweep` does) it prints files, operations, and the efficiency: the time that the runs alone would
take over the time until the last node is done. The duration of a run is uniformly distributed by ±50 %.

With --merge: generates LOGS logs from the results of a few real runs, and measures a merge of them.

With --efficiency: runs SEEDS seeds of the paper's warehouse in one process and in two at the same time, as
shards and under mpirun. Efficiency is by CPU time, so that other load on the machine matters little: that
of the one process over twice that of the busier of the two. Also prints core hours for a million runs.
"""

import argparse
import heapq
import json
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile
import time
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
NODES = (1, 10, 100, 1000, 10_000)
# Metadata operations at a start: suite, scenario, world and models (some 15 files), sweep.json, the
# folder listing, the log. The program and its libraries are assumed to be local to the node.
START_OPERATIONS = 25
SEED = re.compile(r'"seed":\d+')


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=1_000_000)
    parser.add_argument("--run-s", type=float, default=0.3)
    parser.add_argument("--metadata-per-s", type=float, default=10_000)
    parser.add_argument("--writes-per-s", type=float, default=5_000)
    parser.add_argument("--start-s", type=float, default=0.3)
    parser.add_argument("--save-every-s", type=float, default=5.0)
    parser.add_argument("--merge", type=int)
    parser.add_argument("--efficiency", type=int)
    parser.add_argument("--runs-each", type=int, default=10)
    parser.add_argument("--tagfield", default=ROOT / "build/release/bin/tagfield")
    return parser.parse_args()


class Queue:
    """Serves one operation after another, in order of arrival."""

    def __init__(self, per_s):
        self.each_s = 1.0 / per_s
        self.free_s = 0.0
        self.count = 0

    def serve(self, now_s, operations=1):
        """The time at which operations that arrive now are completed."""
        self.count += operations
        self.free_s = max(self.free_s, now_s) + operations * self.each_s
        return self.free_s


def simulate(args, way, nodes):
    """Efficiency, time until the last node is done [s], files, metadata operations and writes."""
    metadata, writes = Queue(args.metadata_per_s), Queue(args.writes_per_s)
    chance = random.Random(1)
    share = [args.runs // nodes + (1 if i < args.runs % nodes else 0) for i in range(nodes)]
    start_operations = START_OPERATIONS + (nodes if way == "all logs read" else 0)
    # Number of runs per save; each save is an event.
    each = {"file a run": 1, "all logs read": 1}.get(way, max(1, round(args.save_every_s / args.run_s)))
    events = [(chance.random(), i, -1) for i in range(nodes)]
    heapq.heapify(events)
    end_s = 0.0
    while events:
        now_s, node, left = heapq.heappop(events)
        if left < 0:
            ready_s = metadata.serve(now_s, start_operations) + args.start_s
            heapq.heappush(events, (ready_s, node, share[node]))
            continue
        if left < share[node] or left == 0:
            if way == "file a run":  # Create, sync, rename.
                now_s = writes.serve(metadata.serve(now_s, 2))
            else:
                now_s = writes.serve(now_s)
        if left == 0:
            end_s = max(end_s, now_s)
            continue
        count = min(each, left)
        # The relative scatter of a sum of many runs is small.
        spent_s = args.run_s * (count + (chance.random() - 0.5) * count ** 0.5)
        heapq.heappush(events, (now_s + spent_s, node, left - count))
    files = args.runs if way == "file a run" else nodes
    return args.runs * args.run_s / nodes / end_s, end_s, files, metadata.count, writes.count


def print_simulation(args):
    print(f"{args.runs} runs of {args.run_s} s, {args.runs * args.run_s / 3600:.0f} core hours; metadata "
          f"{args.metadata_per_s:.0f}/s, small writes {args.writes_per_s:.0f}/s")
    print("| way | nodes | files | metadata operations | writes | until the last is done [s] | efficiency |")
    print("|---|---|---|---|---|---|---|")
    for way in ("file a run", "all logs read", "as it is"):
        for nodes in NODES:
            efficiency, end_s, files, metadata, writes = simulate(args, way, nodes)
            print(f"| {way} | {nodes} | {files} | {metadata} | {writes} | {end_s:.0f} | {efficiency:.3f} |")


def suite_text(points, seeds):
    scenario = ROOT / "scenarios/paper_warehouse.yaml"
    return (f"name: scale\nscenario: {scenario}\nseeds: {seeds}\nmethods: [hyperbola]\n"
            "conditions: [{name: noisy, set: {pose.source: noisy}}]\n"
            f"sweep: {{grid: {{pose.sigma_m: {{from: 0.001, to: 0.1, steps: {points}}}}}}}\n")


def forge(folder, suite, args, points, seeds):
    """Writes synthetic logs as of args.merge shards, from the results of a few runs."""
    subprocess.run([args.tagfield, "sweep", suite, "--shard", f"1/{points * seeds // 4}", "--out", folder],
                   check=True, stdout=subprocess.DEVNULL)
    made = next((folder / "shards").rglob("*.log"))
    head, *lines = made.read_text(encoding="utf-8").splitlines()
    bodies = [line.split(" ", 4) for line in lines]
    made.unlink()
    made.parent.rmdir()
    logs = folder / f"shards/of_{args.merge}"
    logs.mkdir()
    runs = points * seeds
    for shard in range(args.merge):
        text = [head]
        for run in range(shard, runs, args.merge):
            _, _, state, seconds, body = bodies[run % len(bodies)]
            seed = run % seeds + 1
            body = SEED.sub(f'"seed":{seed}', body)
            rest = f"{run // seeds}:{seed} {state} {seconds} {body}"
            text.append(f"{zlib.crc32(rest.encode()):08x} {rest}")
        (logs / f"{shard + 1}.log").write_text("\n".join(text) + "\n", encoding="utf-8")


def print_merge(args):
    runs = args.merge * args.runs_each
    seeds = 100
    points = max(2, runs // seeds)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        suite = folder / "suite.yaml"
        suite.write_text(suite_text(points, seeds), encoding="utf-8")
        forge(folder / "out", suite, args, points, seeds)
        size = sum(log.stat().st_size for log in (folder / "out/shards").rglob("*.log"))
        begin = time.monotonic()
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([args.tagfield, "sweep", "--merge", folder / "out"], check=True,
                       stdout=subprocess.DEVNULL)
        wall_s = time.monotonic() - begin
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu_s = used.ru_utime + used.ru_stime - before.ru_utime - before.ru_stime
        database = (folder / "out/results.sqlite").stat().st_size
        json.loads((folder / "out/results.json").read_text(encoding="utf-8"))
        print(f"{args.merge} logs, {points * seeds} runs, {size / 1e6:.0f} MB: merged in {wall_s:.1f} s, {cpu_s:.1f} s of CPU, "
              f"{used.ru_maxrss / 1e3:.0f} MB of memory; results.sqlite {database / 1e6:.0f} MB")


def cpu_seconds_of(commands):
    """CPU time of each command including its child processes; all run at the same time."""
    code = ("import resource, subprocess, sys; code = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL)"
            ".returncode; used = resource.getrusage(resource.RUSAGE_CHILDREN); "
            "print(used.ru_utime + used.ru_stime); sys.exit(code)")
    started = [subprocess.Popen([sys.executable, "-c", code, *map(str, command)], stdout=subprocess.PIPE)
               for command in commands]
    seconds = [float(process.communicate()[0]) for process in started]
    if any(process.returncode != 0 for process in started):
        sys.exit("a sweep did not end well")
    return seconds


def logged_seconds(folder):
    """CPU time of the runs in each log."""
    return [sum(float(line.split(" ", 4)[3]) for line in log.read_text(encoding="utf-8").splitlines()[1:])
            for log in sorted((folder / "shards").rglob("*.log"))]


def print_efficiency(args):
    program = pathlib.Path(args.tagfield)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        suite = folder / "suite.yaml"
        suite.write_text(f"scenario: {ROOT}/scenarios/paper_warehouse.yaml\nseeds: {args.efficiency}\n"
                         "methods: [hyperbola]\nconditions: [{name: as it is}]\n", encoding="utf-8")
        sweep = [program, "sweep", suite, "--threads", "1"]
        (one,) = cpu_seconds_of([[*sweep, "--shard", "1/1", "--out", folder / "one"]])
        (runs,) = logged_seconds(folder / "one")
        print(f"1 process: {one:.2f} s of CPU for {args.efficiency} runs, {runs / args.efficiency * 1e3:.1f} ms "
              f"each, {one - runs:.2f} s around them; a million: {runs / args.efficiency * 1e6 / 3600:.1f} "
              "core hours")
        two = cpu_seconds_of([[*sweep, "--shard", f"{i}/2", "--out", folder / "two"] for i in (1, 2)])
        print(f"2 shards: {two[0]:.2f} and {two[1]:.2f} s, efficiency {one / (2 * max(two)):.3f}")
        mpi = program.parent / "tagfield_sweep_mpi"
        if mpi.exists():
            (both,) = cpu_seconds_of([["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", 2, mpi, suite,
                                       "--out", folder / "mpi", "--no-page"]])
            ranks = logged_seconds(folder / "mpi")
            print(f"mpirun -np 2, merge included: {both:.2f} s in all, {ranks[0]:.2f} and {ranks[1]:.2f} s of it "
                  f"runs, efficiency {one / both:.3f}")


def main():
    args = arguments()
    if args.efficiency:
        print_efficiency(args)
        return 0
    if args.merge:
        print_merge(args)
    else:
        print_simulation(args)
    return 0


if __name__ == "__main__":
    sys.exit(main())
