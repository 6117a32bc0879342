#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Injects faults into each command, many times, and checks the remaining files.

    fault_campaign_test.py --tagfield PROGRAM --source SOURCE_DIR [--times N] [--seed N] [--only WORD]… [--kind KIND]…

Commands that write results: SIGKILL at random times, SIGINT and SIGTERM, errors of each kind of system
call (faults.c), limits on open files, memory and file size, and clock jumps. Commands that print: a
reader that closes the pipe early. `serve`: killed while clients are connected, and clients that vanish.
Afterwards there must be either the complete old result or the complete new one, and no leftovers after
the next run; if the program can report an error, it is one line with exit code 2.

The exit code is 0 if no fault is found, else 1; each finding is printed with the steps to reproduce it.
"""

import argparse
import collections
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

from common import clean_environment, files_in, read_csv
from faulty import counts_in, environment_with, fault_library, is_left_over, result_in

MOST_SECONDS = 120
SUITE = """scenario: {scenario}
seeds: 2
methods: [hyperbola]
conditions: [{{name: plain, set: {{duration_s: {duration}}}}}]
"""
EVENTS = "events:\n  presence: {{gone_after_s: {timeout}}}\n"
# (call, error, "+" if all later calls fail as well).
FAULTS = (("write", "ENOSPC", "+"), ("write", "EIO", ""), ("sync", "EIO", ""), ("rename", "EIO", ""),
          ("rename", "EACCES", "+"), ("mkdir", "ENOSPC", ""), ("open", "EMFILE", ""),
          ("open", "EACCES", ""), ("read", "EIO", ""), ("thread", "EAGAIN", "+"),
          ("alloc", "ENOMEM", ""), ("alloc", "ENOMEM", "+"), ("clock", "86400", "+"),
          ("clock", "-86400", "+"))
HARMLESS = ("thread", "clock")  # The result is complete nevertheless.


class Command:
    """A command that writes to `out`, with the arguments of the old result and of the new one."""

    def __init__(self, name, before, now):
        self.name = name
        self.before = [str(word) for word in before]
        self.now = [str(word) for word in now]


class Campaign:
    """Settings and findings of all campaigns."""

    def __init__(self, arguments, folder):
        self.tagfield = arguments.tagfield.resolve()
        self.source = arguments.source.resolve()
        self.times = arguments.times
        self.only = arguments.only
        self.kinds = arguments.kind
        self.folder = folder
        self.random = random.Random(arguments.seed)
        self.library = fault_library(folder)
        self.findings = []
        self.rows = []

    def find(self, what, how):
        self.findings.append(f"{what}: {how}")
        print(f"FOUND {what}: {how}", flush=True)

    def start(self, words, **options):
        settings = {"env": clean_environment(), "stdout": subprocess.DEVNULL,
                    "stderr": subprocess.PIPE} | options
        return subprocess.Popen([str(self.tagfield), *words], cwd=self.folder,
                                stdin=subprocess.DEVNULL, **settings)

    def run(self, words, **options):
        """Exit code and standard error; the code is None if it does not end in time."""
        program = self.start(words, **options)
        try:
            _, said = program.communicate(timeout=MOST_SECONDS)
        except subprocess.TimeoutExpired:
            program.kill()
            program.communicate()
            return None, ""
        return program.returncode, said.decode("utf-8", "replace")

    def run_well(self, words):
        code, said = self.run(words)
        if code != 0:
            raise RuntimeError(f"{' '.join(words)}: exit code {code}: {said}")

    def out(self):
        return result_in(files_in(self.folder / "out"))

    def left_over(self):
        return sorted(name for name in files_in(self.folder) if is_left_over(name))

    def clear(self):
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        for path in list(self.folder.iterdir()):
            if is_left_over(path.name):
                shutil.rmtree(path, ignore_errors=True)

    def drawn(self, most):
        """`--times` random numbers of 1…most, or all."""
        every = range(1, most + 1)
        return sorted(self.random.sample(every, self.times)) if most > self.times else list(every)


# --- The commands -----------------------------------------------------------------------------------


def shipped(campaign, name):
    return campaign.source / "scenarios" / f"{name}.yaml"


def prepare(campaign):
    """Writes the inputs and returns the commands that use them."""
    two, axis = shipped(campaign, "two_antennas"), shipped(campaign, "z_axis")
    campaign.run_well(["run", str(two), "--out", "two", "--no-page"])
    campaign.run_well(["run", str(axis), "--out", "axis", "--no-page"])
    campaign.run_well(["run", str(two), "--seed", "2", "--out", "other", "--no-page"])
    folder = campaign.folder
    for name in ("two", "axis"):
        tags = {row["tag"]: row for row in read_csv(folder / name / "truth/tags.csv")}
        rows = [",".join((tag, row["x_m"], row["y_m"], row["z_m"])) for tag, row in tags.items()]
        (folder / f"{name}_tags.csv").write_text("tag,x_m,y_m,z_m\n" + "\n".join(rows) + "\n")
    for duration in (2, 3):
        (folder / f"suite_{duration}.yaml").write_text(
            SUITE.format(scenario=axis, duration=duration))
        (folder / f"events_{duration}.yaml").write_text(EVENTS.format(timeout=duration))

    def reads(name):
        return [f"{name}/reads.csv", "--poses", f"{name}/antenna_poses.csv"]

    def calibrate(name):
        return ["calibrate", *reads(name), "--tags", f"{name}_tags.csv", "--out", "out/p.yaml"]

    def events(timeout):
        return ["events", "two/reads.csv", "--spec", f"events_{timeout}.yaml", "--epcis",
                "out/events.json"]

    out = ["--out", "out"]
    aisle = shipped(campaign, "plan/aisle")
    commands = [
        Command("run", ["run", two, *out], ["run", axis, "--force", *out]),
        Command("run --record-only", ["run", two, "--record-only", *out],
                ["run", axis, "--record-only", "--force", *out]),
        Command("localize", ["localize", *reads("two"), *out],
                ["localize", *reads("axis"), "--method", "sar", *out]),
        Command("track", ["track", *reads("two"), "--lane", "0", "0", "0", *out],
                ["track", *reads("axis"), "--lane", "0", "0", "0", *out]),
        Command("calibrate", calibrate("two"), calibrate("axis")),
        Command("bench", ["bench", "suite_2.yaml", "--no-timing", *out],
                ["bench", "suite_3.yaml", "--no-timing", *out]),
        Command("coverage", ["coverage", two, "--height", "1", "--step", "1", *out],
                ["coverage", two, "--height", "1.5", "--step", "1", *out]),
        Command("events", events(2), events(3)),
        Command("gazebo", ["gazebo", two, "--out", "out/w.world"],
                ["gazebo", axis, "--out", "out/w.world"]),
        Command("compare", ["compare", "two", "two", *out], ["compare", "two", "other", *out]),
        # Cached links grow during a run and remain for the next one; tests of `plan` interrupt them.
        Command("plan", ["plan", aisle, "--samples", "8", "--no-links", *out],
                ["plan", aisle, "--samples", "9", "--no-links", *out])]
    return [command for command in commands if not campaign.only or
            any(word in command.name for word in campaign.only)]


class Outcomes:
    """The old and the new result of one command, and checks of what a fault leaves."""

    def __init__(self, campaign, command):
        self.campaign = campaign
        self.command = command
        self.saved = campaign.folder / "saved"
        shutil.rmtree(self.saved, ignore_errors=True)
        campaign.clear()
        (campaign.folder / "out").mkdir()
        campaign.run_well(command.before)
        self.old = campaign.out()
        shutil.copytree(campaign.folder / "out", self.saved)
        begin = time.monotonic()
        campaign.run_well(command.now)
        self.seconds = time.monotonic() - begin
        self.new = {name: content for name, content in campaign.out().items()}
        if self.old == self.new:
            raise RuntimeError(f"{command.name}: both forms give the same")

    def restore(self):
        self.campaign.clear()
        shutil.copytree(self.saved, self.campaign.folder / "out")

    def which(self, cut_off=False):
        """Which result there is. An aborted command may leave resume.log next to the old result."""
        found = self.campaign.out()
        if cut_off and found != self.new:
            found.pop("resume.log", None)
        return "old" if found == self.old else "new" if found == self.new else "neither"

    def look(self, what, allowed=("old", "new")):
        """Checks the current result, runs the command to completion, and checks again."""
        outcome = self.which(cut_off=True)
        if outcome not in allowed:
            self.campaign.find(f"{self.command.name}, {what}", f"the folder holds {outcome}")
        code, said = self.campaign.run(self.command.now)
        if code != 0:
            self.campaign.find(f"{self.command.name}, {what}", f"then exit code {code}: {said[:300]}")
        elif self.which() != "new":
            self.campaign.find(f"{self.command.name}, {what}", "then another result")
        left = self.campaign.left_over()
        if left:
            self.campaign.find(f"{self.command.name}, {what}", f"left over: {left}")
            self.campaign.clear()
        return outcome


def complain(campaign, what, code, said, allowed=(0, 2)):
    """Records a finding unless the exit code is allowed and an error is reported in one line."""
    lines = [line for line in said.splitlines() if not line.startswith("tagfield: warning")]
    if code not in allowed:
        campaign.find(what, f"exit code {code}: {said[:300]!r}")
    elif code == 2 and (len(lines) != 1 or not lines[0].startswith("tagfield: ")):
        campaign.find(what, f"says {said[:300]!r}")
    elif code == 0 and lines:
        campaign.find(what, f"exit code 0, and says {said[:300]!r}")


def summary_of(counter):
    return ", ".join(f"{count} {name}" for name, count in sorted(counter.items()))


# --- The campaigns ----------------------------------------------------------------------------------


def killed(campaign, outcomes):
    """SIGKILL at random times."""
    seen = collections.Counter()
    for _ in range(campaign.times):
        outcomes.restore()
        after = campaign.random.uniform(0, 1.1 * outcomes.seconds)
        program = campaign.start(outcomes.command.now)
        time.sleep(after)
        program.kill()
        program.communicate()
        seen[outcomes.look(f"killed after {after:.3f} s")] += 1
    return summary_of(seen)


def interrupted(campaign, outcomes):
    """SIGINT and SIGTERM: the old result, the new one, or one marked as incomplete."""
    seen = collections.Counter()
    for i in range(campaign.times):
        outcomes.restore()
        number = (signal.SIGINT, signal.SIGTERM)[i % 2]
        after = campaign.random.uniform(0, 1.1 * outcomes.seconds)
        what = f"{outcomes.command.name}, {number.name} after {after:.3f} s"
        program = campaign.start(outcomes.command.now)
        time.sleep(after)
        program.send_signal(number)
        _, said = program.communicate(timeout=MOST_SECONDS)
        code = program.returncode
        if code not in (0, 130, -number):
            campaign.find(what, f"exit code {code}: {said.decode()[:300]}")
        says_so = code == 130 and is_marked(campaign.folder / "out")
        left = campaign.left_over()
        if left and after > 0.1:
            campaign.find(what, f"left over: {left}")
        outcome = outcomes.which(cut_off=True)
        if outcome == "neither" and says_so:
            outcome = "marked as incomplete"
        seen[outcome] += 1
        outcomes.look(what, (*(("neither",) if says_so else ()), "old", "new"))
    return summary_of(seen)


def is_marked(folder):
    """Whether a result is marked as incomplete."""
    if (folder / "INCOMPLETE").exists():
        return True
    for name in ("bench.json", "tracks.json"):
        if (folder / name).exists():
            return json.loads((folder / name).read_text()).get("complete") is False
    return False


def faulty_calls(campaign, outcomes):
    """Errors of system calls, at randomly drawn calls or at all."""
    outcomes.restore()
    path = campaign.folder / "counts"
    code, said = campaign.run(outcomes.command.now,
                              env=environment_with(campaign.library, count_file=path))
    if code != 0:
        campaign.find(outcomes.command.name, f"with the counting library: {said[:300]}")
        return "none"
    counts = counts_in(path)
    seen = collections.Counter()
    for call, error, goes_on in FAULTS:
        for number in campaign.drawn(counts[call]):
            fault = f"{call}:{number}{goes_on}:{error}"
            what = f"{outcomes.command.name}, FAULT={fault}"
            outcomes.restore()
            code, said = campaign.run(outcomes.command.now,
                                      env=environment_with(campaign.library, fault))
            complain(campaign, what, code, said, (0,) if call in HARMLESS else (0, 2))
            if code == 0 and outcomes.which() != "new":
                campaign.find(what, "exit code 0 without the new result")
            seen[call] += 1
            outcomes.look(what)
    return summary_of(seen)


def limited(campaign, outcomes):
    """Limits on open files, memory and file size by setrlimit(2)."""
    limits = ((resource.RLIMIT_NOFILE, range(3, 40)),
              (resource.RLIMIT_AS, range(20_000_000, 900_000_000, 2_000_000)),
              (resource.RLIMIT_FSIZE, range(0, 60_000, 500)))
    seen = collections.Counter()
    for limit, values in limits:
        for value in campaign.random.sample(list(values), min(campaign.times, len(values))):
            name = {resource.RLIMIT_NOFILE: "files", resource.RLIMIT_AS: "memory",
                    resource.RLIMIT_FSIZE: "file size"}[limit]
            what = f"{outcomes.command.name}, {name} limited to {value}"
            outcomes.restore()
            code, said = campaign.run(
                outcomes.command.now,
                preexec_fn=lambda: resource.setrlimit(limit, (value, value)))  # pylint: disable=W0640
            if code == 127:  # The loader could not load the program within the limit.
                continue
            complain(campaign, what, code, said)
            seen[name] += 1
            outcomes.look(what)
    return summary_of(seen)


def nobody_reads_on(campaign, commands):
    """Only the beginning of the output is read."""
    two = shipped(campaign, "two_antennas")
    printing = (["stream", str(two)], ["check", str(two)], ["explain", "--help"],
                ["events", "two/reads.csv", "--spec", "events_2.yaml", "--json"],
                ["check", str(two), "--json"])
    del commands
    seen = collections.Counter()
    for words in printing:
        for i in range(campaign.times):
            program = campaign.start(words, stdout=subprocess.PIPE)
            os.read(program.stdout.fileno(), 1 + i * 10)
            program.stdout.close()
            said = program.stderr.read().decode("utf-8", "replace")
            program.stderr.close()
            program.wait(timeout=MOST_SECONDS)
            complain(campaign, f"{' '.join(words)} | head", program.returncode, said,
                     (0, 2, -signal.SIGPIPE))
            seen[words[0]] += 1
    return summary_of(seen)


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def wait_for(port, program):
    """Connects as soon as the program listens on the port; None if it ends or does not listen."""
    for _ in range(200):
        try:
            return socket.create_connection(("127.0.0.1", port), timeout=5)
        except OSError:
            if program.poll() is not None:
                return None
            time.sleep(0.05)
    return None


def serving(campaign, commands):
    """`serve` is killed while clients are connected, and starts again on its port; clients vanish."""
    del commands
    port = free_port()
    words = ["serve", str(shipped(campaign, "two_antennas")), "--http", str(port)]
    seen = collections.Counter()
    for i in range(campaign.times):
        program = campaign.start(words)
        clients = [wait_for(port, program) for _ in range(3)]
        if None in clients:
            program.kill()
            campaign.find("serve", f"does not start again on its port: {program.stderr.read()[:300]}")
            break
        for client in clients:
            client.sendall(b"GET /api/v1/state HTTP/1.1\r\nHost: localhost\r\n\r\n"[:10 + 20 * i])
        clients[0].setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
        clients[0].close()  # by a reset
        time.sleep(campaign.random.uniform(0, 0.3))
        if program.poll() is not None:
            campaign.find("serve", f"ended with {program.returncode}")
        number = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)[i % 3]
        program.send_signal(number)
        try:
            _, said = program.communicate(timeout=20)
        except subprocess.TimeoutExpired:
            campaign.find("serve", f"goes on after {number.name}")
            program.kill()
            continue
        finally:
            for client in clients[1:]:
                client.close()
        if number != signal.SIGKILL and program.returncode not in (0, 130):
            campaign.find("serve", f"{number.name}: exit code {program.returncode}: {said[:300]}")
        seen[number.name] += 1
    return summary_of(seen)


KINDS = (killed, interrupted, faulty_calls, limited)


def run_campaigns(campaign):
    commands = prepare(campaign)
    for command in commands:
        outcomes = Outcomes(campaign, command)
        for each in KINDS:
            if not campaign.kinds or each.__name__ in campaign.kinds:
                measured(campaign, command.name, each, outcomes)
    for each in (nobody_reads_on, serving):
        if each.__name__ in campaign.only or not (campaign.only or campaign.kinds):
            measured(campaign, "", each, commands)


def measured(campaign, name, each, subject):
    """Runs a campaign and prints its row of the table."""
    begin = time.monotonic()
    before = len(campaign.findings)
    seen = each(campaign, subject)
    row = (name, each.__name__.replace("_", " "), seen, f"{time.monotonic() - begin:.0f} s",
           len(campaign.findings) - before)
    print("| {} | {} | {} | {} | {} |".format(*row), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--tagfield", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--source", type=pathlib.Path, required=True, help="the source tree")
    parser.add_argument("--build", type=pathlib.Path, help="not used")
    parser.add_argument("--times", type=int, default=200, help="of each kind (default 200)")
    parser.add_argument("--seed", type=int, default=1, help="of the moments and calls")
    parser.add_argument("--only", action="append", default=[],
                        help="only commands with this in their name, or nobody_reads_on, serving")
    parser.add_argument("--kind", action="append", default=[],
                        choices=[each.__name__ for each in KINDS], help="only this around a command")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="tagfield-") as folder:
        campaign = Campaign(arguments, pathlib.Path(folder))
        run_campaigns(campaign)
    print(f"{len(campaign.findings)} findings")
    sys.exit(1 if campaign.findings else 0)


if __name__ == "__main__":
    main()
