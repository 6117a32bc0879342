#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs each fuzz target on its valid seeds and on all inputs that fuzzing has found.

    fuzz/replay_test.py BUILD
"""

import pathlib
import subprocess
import sys
import tempfile

from seeds import TARGETS, write_all

FINDINGS = pathlib.Path(__file__).resolve().parent / "findings"


def main():
    programs = pathlib.Path(sys.argv[1]) / "bin"
    failed = []
    with tempfile.TemporaryDirectory(prefix="tagfield-") as folder:
        write_all(folder)
        for target in TARGETS:
            program = programs / f"fuzz_{target}"
            if not program.exists():
                print(f"skipped: {target}: {program.name} is not built")
                continue
            files = [path for place in (pathlib.Path(folder) / target, FINDINGS / target)
                     for path in sorted(place.glob("*"))]
            result = subprocess.run([program, *files], capture_output=True, timeout=300, check=False)
            looked_at = result.stdout.decode().splitlines()
            print(f"{target}: {len(looked_at)} of {len(files)} inputs")
            if result.returncode != 0 or len(looked_at) != len(files):
                failed.append(f"{target}: {looked_at[-1:]}: {result.stderr.decode()[-300:]}")
    for line in failed:
        print(f"FAILED {line}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
