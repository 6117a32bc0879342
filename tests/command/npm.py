"""Packages of npm's that tests use: what others made, to check ours against."""

import functools
import shutil

from common import Skip, run


@functools.cache
def npm_packages(build, here, name):
    """The folder under `build` with what package-lock.json in the folder `here` names; installed if
    need be. Skips the case where that can't be had."""
    for program in ("node", "npm"):
        if shutil.which(program) is None:
            raise Skip(f"{program} is missing (scripts/setup --tests installs it)")
    folder = build / "tests" / name
    lock = (here / "package-lock.json").read_bytes()
    installed = folder / "installed.json"
    if not installed.exists() or installed.read_bytes() != lock:
        folder.mkdir(parents=True, exist_ok=True)
        for file in ("package.json", "package-lock.json"):
            shutil.copy(here / file, folder)
        result = run(["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts"], cwd=folder)
        if result.code != 0:
            said = [line for line in result.err.splitlines() if line.lower().startswith("npm err")]
            raise Skip(f"npm can't install {name}'s packages: {' '.join(said[:1]) or result.err!r}")
        installed.write_bytes(lock)
    return folder
