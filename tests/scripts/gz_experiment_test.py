#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/gz-experiment finds a gz-sim in a separate prefix with the system's `ign` or `gz`, which knows
it only by the commands in that prefix.

    gz_experiment_test.py SOURCE_DIR
"""

import os
import pathlib
import subprocess
import sys
import tempfile

# Like the real ones: a command exists if a folder in the variable has its file.
COMMAND = """#!/bin/sh
IFS=:
for folder in ${VARIABLE}; do
  [ -f "$folder/sim.yaml" ] && echo 1.2.3
done
exit 0
"""


def check(source, program, variable, kind):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        system = folder / "bin"
        system.mkdir()
        (system / program).write_text(COMMAND.replace("VARIABLE", variable), encoding="utf-8")
        (system / program).chmod(0o755)
        commands = folder / "prefix/share" / kind
        commands.mkdir(parents=True)
        (commands / "sim.yaml").touch()
        env = {**os.environ, "PATH": f"{system}:/usr/bin:/bin", variable: "/elsewhere"}
        env.pop("TAGFIELD_GZ_PREFIX", None)
        (system / ("gz" if program == "ign" else "ign")).symlink_to("/bin/false")
        for prefix, code in ((None, 77), (folder / "prefix", 0), (folder / "bin", 77)):
            if prefix is not None:
                env["TAGFIELD_GZ_PREFIX"] = str(prefix)
            done = subprocess.run([source / "scripts/gz-experiment", "--check"], env=env, check=False,
                                  stderr=subprocess.PIPE, text=True, timeout=60)
            assert done.returncode == code, (program, prefix, done.returncode, done.stderr)
            assert (code == 0) == ("gz-sim is not found" not in done.stderr), done.stderr


def main():
    source = pathlib.Path(sys.argv[1])
    check(source, "ign", "IGN_CONFIG_PATH", "ignition")
    check(source, "gz", "GZ_CONFIG_PATH", "gz")


if __name__ == "__main__":
    main()
