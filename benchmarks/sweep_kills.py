#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Kills shards of a sweep at random and resumes them: no run may be lost or repeated.

    benchmarks/sweep_kills.py [--tagfield build/release/bin/tagfield] [--kills 50] [--shards 3]
                              [--seed 1] [--save-every 0.2] [SUITE]

Runs the complete suite without interruption; then its shards in parallel, which are killed (SIGKILL) at
random and resumed, --kills times at most; then merges them. Prints how many runs are lost, how many were
done twice, and which result files differ from those of the first sweep. The exit code is 1 unless all
is as it should be.
"""

import argparse
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ("points.csv", "runs.csv", "results.json", "results.sqlite", "sweep.html")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("suite", nargs="?", default=ROOT / "scenarios/sweep/pose_and_noise.yaml")
    parser.add_argument("--tagfield", default=ROOT / "build/release/bin/tagfield")
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--shards", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--save-every", default="0.2")
    return parser.parse_args()


class Shards:
    """The processes of the shards."""

    def __init__(self, args, folder):
        self.args = args
        self.folder = folder
        self.running = {}
        self.done = set()

    def start_missing(self):
        for shard in range(1, self.args.shards + 1):
            if shard not in self.running and shard not in self.done:
                self.running[shard] = subprocess.Popen(
                    [self.args.tagfield, "sweep", self.args.suite, "--shard",
                     f"{shard}/{self.args.shards}", "--out", self.folder, "--threads", "1",
                     "--save-every", self.args.save_every], stdout=subprocess.DEVNULL)

    def reap(self):
        for shard, process in list(self.running.items()):
            if process.poll() is not None:
                del self.running[shard]
                if process.returncode != 0:
                    sys.exit(f"shard {shard} ended with {process.returncode}")
                self.done.add(shard)

    def kill_one(self, chance):
        """Kills a random running shard; returns whether one was killed before its end."""
        self.reap()
        if not self.running:
            return False
        shard = chance.choice(sorted(self.running))
        process = self.running.pop(shard)
        process.send_signal(signal.SIGKILL)
        code = process.wait()
        if code == -signal.SIGKILL:
            return True
        if code != 0:
            sys.exit(f"shard {shard} ended with {code}")
        self.done.add(shard)
        return False


def killed_and_resumed(args, folder):
    """Runs all shards to the end, with kills, and returns the number of kills."""
    chance = random.Random(args.seed)
    shards = Shards(args, folder)
    kills = 0
    while len(shards.done) < args.shards:
        shards.start_missing()
        time.sleep(chance.expovariate(1.0 / 0.4))
        if kills < args.kills and shards.kill_one(chance):
            kills += 1
        shards.reap()
    return kills


def keys_in(folder):
    return [line.split(" ")[1] for log in sorted((folder / "shards").rglob("*.log"))
            for line in log.read_text(encoding="utf-8").splitlines()[1:]]


def main():
    args = arguments()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([args.tagfield, "sweep", args.suite, "--out", folder / "whole"], check=True,
                       stdout=subprocess.DEVNULL)
        kills = killed_and_resumed(args, folder / "killed")
        subprocess.run([args.tagfield, "sweep", "--merge", folder / "killed"], check=True,
                       stdout=subprocess.DEVNULL)
        keys = keys_in(folder / "killed")
        expected = set(keys_in(folder / "whole"))
        differ = [file for file in RESULTS if (folder / "whole" / file).read_bytes() !=
                  (folder / "killed" / file).read_bytes()]
        print(f"{kills} kills, {len(expected)} runs: {len(expected - set(keys))} lost, "
              f"{len(keys) - len(set(keys))} in the logs twice, files that differ: {differ or 'none'}")
        return 1 if differ or set(keys) != expected or len(keys) != len(set(keys)) else 0


if __name__ == "__main__":
    sys.exit(main())
