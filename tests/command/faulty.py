# SPDX-License-Identifier: Apache-2.0
"""Fault injection for the program: faults.c, signals, limits."""

import os
import pathlib
import shutil
import subprocess

from common import Skip, clean_environment

# Files that include wall times.
TIMED = ("summary.json", "report.html", "tracks.json")


def fault_library(folder):
    """Builds faults.c in a folder and returns the library's path."""
    source = pathlib.Path(__file__).parent / "faults.c"
    library = folder / "faults.so"
    if "TAGFIELD_SANITIZED" in os.environ:
        raise Skip("sanitizers want to be first among the libraries that are loaded before others")
    if shutil.which("cc") is None:
        raise Skip("there is no C compiler to build faults.c with")
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror", "-o", library,
                    source, "-ldl"], check=True)
    return library


def environment_with(library, fault=None, count_file=None):
    """The environment of a program into which the fault is injected."""
    environment = clean_environment() | {"LD_PRELOAD": str(library)}
    if fault is not None:
        environment["FAULT"] = fault
    if count_file is not None:
        environment["COUNT_FILE"] = str(count_file)
    return environment


def counts_in(count_file):
    """Number of calls by name."""
    lines = count_file.read_text(encoding="ascii").splitlines()
    return {name: int(count) for name, count in (line.split() for line in lines)}


def is_left_over(name):
    """Whether a file is a leftover of a killed program, which the next run removes."""
    parts = pathlib.PurePath(name).parts
    return any(part.startswith("incomplete-") or ".tagfield-" in part or part.endswith(".partial")
               for part in parts)


def result_in(files):
    """The result among files by path, without leftovers and without content that includes wall times."""
    return {name: None if pathlib.PurePath(name).name in TIMED else content
            for name, content in files.items() if not is_left_over(name)}
