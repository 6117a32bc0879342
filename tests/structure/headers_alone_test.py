#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Each installed header compiles on its own, without warnings.

    headers_alone_test.py SOURCE_DIR [--since FILE]

With --since, checks only headers that changed since the commit named in FILE (when scripts/lint checked
all), that include a changed header directly or indirectly, or whose room's CMakeLists.txt changed. Checks
all if this test changed, too, or if there is no such commit.
"""

import argparse
import concurrent.futures
import functools
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from changes import changed_since  # noqa: E402
from public_headers_test import public_headers  # noqa: E402

RULES = {f"tests/structure/{name}.py" for name in ("headers_alone_test", "public_headers_test", "changes")}
INCLUDE = re.compile(r'^#include [<"](.*)[>"]', re.MULTILINE)
EIGEN = "Eigen/Core"
COMPILE = ("c++", "-std=c++20", "-Wall", "-Wextra", "-Werror", "-isystem", "/usr/include/eigen3")
PLANTED = "inline std::string planted() { return {}; }\n"


@functools.lru_cache(maxsize=None)
def headers_behind(name, top):
    """The header itself and all headers that it includes, directly or indirectly."""
    path = top / name
    others = INCLUDE.findall(path.read_text(encoding="utf-8")) if path.is_file() else []
    return frozenset({name}).union(*(headers_behind(other, top) for other in others))


def room_list_of(header):
    """The CMakeLists.txt that lists the header as installed."""
    return "/".join(header.split("/")[:2]) + "/CMakeLists.txt"


def looked_at(headers, since, top):
    """The headers to check, and the reason in words."""
    if since is None:
        return headers, "all"
    commit = since.read_text(encoding="utf-8").split()[0]
    names = changed_since(commit, str(top), RULES)
    if names is None:
        return headers, f"all, as what changed since {commit[:12]} can't be told or the rules changed"
    chosen = [name for name in headers if names & (headers_behind(name, top) | {room_list_of(name)})]
    return chosen, f"changed since {commit[:12]}"


class Compiler:
    """A compiler with a precompiled header of Eigen, whose parsing takes most of the time."""

    def __init__(self, top, folder):
        self.top = top
        self.folder = pathlib.Path(folder)
        self.eigen = self.folder / "eigen.h"
        self.eigen.write_text(f"#include <{EIGEN}>\n", encoding="utf-8")
        subprocess.run([*COMPILE, "-x", "c++-header", self.eigen, "-o", f"{self.eigen}.gch"], check=True)

    def said_of(self, header, root=None):
        """Errors and warnings for a program that includes only this header, or ""."""
        root = root or self.top
        program = self.folder / (header.replace("/", "_") + ".cc")
        program.write_text(f'#include "{header}"\n', encoding="utf-8")
        front = ("-include", self.eigen) if EIGEN in headers_behind(header, root) else ()
        done = subprocess.run([*COMPILE, "-fsyntax-only", "-I", root, *front, program],
                              stderr=subprocess.PIPE, text=True, check=False)
        return done.stderr[:600] if done.returncode else ""

    def overlooks_a_fault(self):
        (self.folder / "planted.h").write_text(PLANTED, encoding="utf-8")
        return not self.said_of("planted.h", self.folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--since", type=pathlib.Path)
    arguments = parser.parse_args()
    top = arguments.source.resolve()
    headers, why = looked_at(public_headers(top), arguments.since, top)
    with tempfile.TemporaryDirectory(prefix="headers_alone-") as folder:
        compiler = Compiler(top, folder)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            said = list(pool.map(compiler.said_of, headers))
        failures = [f"{header} does not stand alone: {words}" for header, words in zip(headers, said) if words]
        if compiler.overlooks_a_fault():
            failures.append("a header that lacks an include is taken for well")
    for failure in failures:
        print(failure)
    print(f"{len(headers)} headers ({why}), {len(failures)} failures")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
