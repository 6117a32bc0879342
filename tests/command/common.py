# SPDX-License-Identifier: Apache-2.0
"""Common parts of the tests of the command: arguments, running the program, checks, reading files.

A test file contains functions marked @case and ends with main(). Each case gets a Context; a failed
check() is recorded and the case continues. The exit code is 0 if all pass, 1 if one fails, 77 (skipped)
if there was nothing to run.
"""

import argparse
import csv
import dataclasses
import inspect
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import traceback

SKIPPED = 77
SHARED_DATA = pathlib.Path("../shared/data")
AWS_WORLD = SHARED_DATA / "aws-small-warehouse/worlds/no_roof_small_warehouse.world"
SPEED_OF_LIGHT = 299792458.0
PROGRESS = re.compile(r"tagfield: [^:]+: \d+ %(, [\d.]+ (s|min|h) left)?")


class Skip(Exception):
    """Raised by a case that cannot run here; its text states what is missing."""


@dataclasses.dataclass
class Result:
    """Result of a run of the program. Work of over three seconds, as on a busy machine, says how far it is:
    these lines are in `progress`, not in `err`."""

    code: int
    out: str
    err: str
    seconds: float
    progress: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Context:
    """Environment of a case: the program, the source tree, the build tree, a temporary folder."""

    tagfield: pathlib.Path
    source: pathlib.Path
    build: pathlib.Path
    folder: pathlib.Path
    show: bool = False
    plugins: pathlib.Path = None

    def run(self, *arguments, **options):
        """Runs the program in the case's folder, without GAZEBO_MODEL_PATH and similar variables."""
        return run([self.tagfield, *arguments], cwd=self.folder, **options)

    def run_well(self, *arguments, **options):
        """Like run(), and checks that the exit code is 0."""
        result = self.run(*arguments, **options)
        check(result.code == 0,
              f"{words(arguments)}: exit code {result.code}, {result.err.strip()!r}")
        return result

    def simulate(self, scenario, *arguments, name="out"):
        """Runs a shipped scenario (by name) or one by path, and returns its folder, which is overwritten."""
        path = self.shipped(scenario) if isinstance(scenario, str) else scenario
        folder = self.folder / name
        self.run_well("run", path, "--out", folder, "--force", *arguments)
        return folder

    def shipped(self, name):
        return self.source / "scenarios" / f"{name}.yaml"

    def aws_world(self):
        """The AWS world next to the source folder; skips the case if it does not exist."""
        world = self.source / AWS_WORLD
        if not world.exists():
            raise Skip(f"the AWS warehouse is not there ({world})")
        return world

    def write(self, name, text):
        """Writes a file in the case's folder and returns its path."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(text, bytes):
            path.write_bytes(text)
        else:
            path.write_text(text, encoding="utf-8")
        return path


def words(arguments):
    return " ".join(str(argument) for argument in arguments)


def clean_environment():
    """The caller's environment without variables that change where models are found."""
    drop = {"SDF_PATH", "GAZEBO_MODEL_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GZ_SIM_RESOURCE_PATH"}
    return {name: value for name, value in os.environ.items() if name not in drop}


def run(command, *, cwd=None, timeout=300):
    """Runs a command with empty input; invalid UTF-8 in its output becomes U+FFFD."""
    begin = time.monotonic()
    done = subprocess.run([str(word) for word in command], cwd=cwd, timeout=timeout,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, env=clean_environment(), check=False)
    said = done.stderr.decode("utf-8", "replace").splitlines(keepends=True)
    progress = [line for line in said if PROGRESS.fullmatch(line.rstrip("\n"))]
    err = "".join(line for line in said if line not in progress)
    return Result(done.returncode, done.stdout.decode("utf-8", "replace"), err, time.monotonic() - begin, progress)


_cases = []
_failures = []


def case(function):
    """Marks a function as a test case."""
    _cases.append(function)
    return function


def check(holds, message):
    """Records a failure of the running case, with the line of the check."""
    if not holds:
        caller = inspect.stack()[1]
        while caller.filename == __file__:
            caller = inspect.stack()[inspect.stack().index(caller) + 1]
        _failures.append(f"{pathlib.Path(caller.filename).name}:{caller.lineno}: {message}")
    return bool(holds)


def check_equal(actual, expected, what):
    return check(actual == expected, f"{what} is {actual!r}, expected {expected!r}")


def check_near(actual, expected, tolerance, what):
    return check(actual is not None and abs(actual - expected) <= tolerance,
                 f"{what} is {actual}, expected {expected} ± {tolerance}")


def check_between(actual, low, high, what):
    return check(actual is not None and low <= actual <= high,
                 f"{what} is {actual}, expected {low} to {high}")


def check_in(part, whole, what):
    return check(part in whole, f"{what} lacks {part!r}: {whole[:400]!r}")


def read_csv(path):
    """The rows of a CSV file as dictionaries of strings."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, strict=True))


def read_json(path):
    """The content of a JSON file; NaN and Infinity, which are not valid JSON, raise ValueError."""
    def refuse(word):
        raise ValueError(f"{path} holds {word}")
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"), parse_constant=refuse)


def files_in(folder):
    """Every file under a folder with its bytes, by relative path; folders end in '/'. Without .tagfield,
    the list of files that Tagfield wrote."""
    found = {}
    for path in sorted(pathlib.Path(folder).rglob("*")):
        if path.name == ".tagfield":
            continue
        name = str(path.relative_to(folder))
        found[name + "/" if path.is_dir() else name] = None if path.is_dir() else path.read_bytes()
    return found


def position(row):
    """x_m, y_m, z_m of a CSV row."""
    return tuple(float(row[key]) for key in ("x_m", "y_m", "z_m"))


def percentile(values, share):
    """Percentile by linear interpolation between ranks."""
    ranked = sorted(values)
    rank = share * (len(ranked) - 1)
    low = math.floor(rank)
    high = math.ceil(rank)
    return ranked[low] + (ranked[high] - ranked[low]) * (rank - low)


def arguments_of_test():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tagfield", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--source", type=pathlib.Path, required=True, help="the source tree")
    parser.add_argument("--build", type=pathlib.Path, required=True, help="the build tree")
    parser.add_argument("--plugins", type=pathlib.Path, help="folder with Gazebo's plugins")
    parser.add_argument("--show", action="store_true", help="print what the program says")
    parser.add_argument("cases", nargs="*", help="only cases with one of these in their name")
    return parser.parse_args()


def run_case(function, arguments):
    """Runs a case and returns its outcome as a word; prints the reason unless it passed."""
    _failures.clear()
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="tagfield-") as folder:
        context = Context(arguments.tagfield.resolve(), arguments.source.resolve(),
                          arguments.build.resolve(), pathlib.Path(folder), arguments.show,
                          arguments.plugins and arguments.plugins.resolve())
        try:
            function(context)
        except Skip as skip:
            print(f"SKIPPED {function.__name__}: {skip}")
            return "skipped"
        except Exception:  # pylint: disable=broad-except
            _failures.append(traceback.format_exc())
    outcome = "FAILED" if _failures else "passed"
    print(f"{outcome} {function.__name__} ({time.monotonic() - begin:.1f} s)", flush=True)
    for failure in _failures:
        print(f"    {failure}")
    return outcome


def main():
    arguments = arguments_of_test()
    chosen = [function for function in _cases
              if not arguments.cases or any(word in function.__name__ for word in arguments.cases)]
    outcomes = [run_case(function, arguments) for function in chosen]
    counts = {word: outcomes.count(word) for word in ("passed", "FAILED", "skipped")}
    print(f"{counts['passed']} passed, {counts['FAILED']} failed, {counts['skipped']} skipped")
    if counts["FAILED"] or not outcomes:
        sys.exit(1)
    sys.exit(0 if counts["passed"] else SKIPPED)
