# SPDX-License-Identifier: Apache-2.0
"""npm packages that tests use as independent references."""

import fcntl
import functools
import shutil

from common import Skip, run


def npm(words, folder, what):
    """Runs npm in `folder`; skips the case if that is not possible."""
    for program in ("node", "npm"):
        if shutil.which(program) is None:
            raise Skip(f"{program} is missing (scripts/setup --tests installs it)")
    result = run(["npm", *words], cwd=folder)
    if result.code != 0:
        said = [line for line in result.err.splitlines() if line.lower().startswith("npm err")]
        raise Skip(f"npm can't install {what}: {' '.join(said[:1]) or result.err!r}")


@functools.cache
def require_node(least):
    """Skips the case without Node.js of this major version or a later one."""
    if shutil.which("node") is None:
        raise Skip("node is missing (scripts/setup --tests installs it)")
    version = run(["node", "--version"]).out.strip()
    if int(version.lstrip("v").split(".")[0]) < least:
        raise Skip(f"node is {version}; {least} or later is needed")


def npm_packages(build, here, name, then=None):
    """The folder under `build` with the packages of package-lock.json in the folder `here`, and with what
    `then(folder)` adds; installed if necessary, by one process at a time. Skips the case if that fails."""
    require_node(18)
    folder = build / "tests" / name
    folder.mkdir(parents=True, exist_ok=True)
    lock = (here / "package-lock.json").read_bytes()
    installed = folder / "installed.json"
    with open(folder / "installing.lock", "wb") as alone:
        fcntl.flock(alone, fcntl.LOCK_EX)  # `npm ci` removes packages that another test may be using
        if not installed.exists() or installed.read_bytes() != lock:
            for file in ("package.json", "package-lock.json"):
                shutil.copy(here / file, folder)
            npm(["ci", "--no-audit", "--no-fund", "--ignore-scripts"], folder, f"{name}'s packages")
            if then is not None:
                then(folder)
            installed.write_bytes(lock)
    return folder
