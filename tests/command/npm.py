# SPDX-License-Identifier: Apache-2.0
"""Packages of npm's that tests use: what others made, to check ours against."""

import fcntl
import functools
import shutil

from common import Skip, run


def npm(words, folder, what):
    """Runs npm in `folder`; skips the case where that can't be done."""
    for program in ("node", "npm"):
        if shutil.which(program) is None:
            raise Skip(f"{program} is missing (scripts/setup --tests installs it)")
    result = run(["npm", *words], cwd=folder)
    if result.code != 0:
        said = [line for line in result.err.splitlines() if line.lower().startswith("npm err")]
        raise Skip(f"npm can't install {what}: {' '.join(said[:1]) or result.err!r}")


@functools.cache
def npm_packages(build, here, name, then=None):
    """The folder under `build` with what package-lock.json in the folder `here` names, and with what `then(folder)`
    adds; installed if need be, by one program at a time. Skips the case where that can't be had."""
    folder = build / "tests" / name
    folder.mkdir(parents=True, exist_ok=True)
    lock = (here / "package-lock.json").read_bytes()
    installed = folder / "installed.json"
    with open(folder / "installing.lock", "wb") as alone:
        fcntl.flock(alone, fcntl.LOCK_EX)  # `npm ci` clears the packages that another test is using
        if not installed.exists() or installed.read_bytes() != lock:
            for file in ("package.json", "package-lock.json"):
                shutil.copy(here / file, folder)
            npm(["ci", "--no-audit", "--no-fund", "--ignore-scripts"], folder, f"{name}'s packages")
            if then is not None:
                then(folder)
            installed.write_bytes(lock)
    return folder
