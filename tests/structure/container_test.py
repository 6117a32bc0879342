#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The image built by packaging/Containerfile contains all project packages that its packages depend on.

    container_test.py SOURCE_DIR

Otherwise apt-get would search for a missing one in Debian, and fail.
"""

import pathlib
import re
import sys


def packages_in(text):
    """The project's packages and their dependencies among each other, from TagfieldPackages.cmake."""
    depends = {}
    for call in re.split(r"\btagfield_package\(", text)[1:]:
        name = call.split()[1]
        listed = re.search(r"\bDEPENDS\b(.*?)(?:\bRECOMMENDS\b|\bSUGGESTS\b|\)\s*\n)", call, re.DOTALL)
        depends[name] = set(re.findall(r'"([a-z0-9-]+) \(= \$\{PROJECT_VERSION\}\)"', listed[1])) if listed else set()
    return depends


def missing(cmake, container):
    depends = packages_in(cmake)
    installed = set(re.findall(r"/tmp/packages/([a-z0-9-]+)_\*\.deb", container))
    unknown = installed - depends.keys()
    return unknown | set().union(*(depends[name] for name in installed & depends.keys())) - installed


def main():
    source = pathlib.Path(sys.argv[1])
    cmake = (source / "cmake/TagfieldPackages.cmake").read_text(encoding="utf-8")
    container = (source / "packaging/Containerfile").read_text(encoding="utf-8")
    left_out = missing(cmake, container)
    if left_out:
        sys.exit(f"packaging/Containerfile: not installed, or no packages of ours: {', '.join(sorted(left_out))}")
    # Checks that a missing package is detected.
    if missing(cmake, container.replace("/tmp/packages/tagfield-common_*.deb", "")) != {"tagfield-common"}:
        sys.exit("container_test.py: a package that is left out goes unnoticed")
    print("the image gets what its packages depend on")


if __name__ == "__main__":
    main()
