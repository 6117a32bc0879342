#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Installed headers include only installed headers, docs/api.md lists them, and examples use no others.

    public_headers_test.py SOURCE_DIR

Checks the source tree, then that violations are detected: each rule is broken once in a small tree.
"""

import pathlib
import re
import sys
import tempfile

LIST = re.compile(r"(?:PUBLIC_HEADERS|tagfield_public_headers\(\w+)((?:\s+[\w/]+\.h)+)")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"](tagfield/[^">]+)[">]', re.MULTILINE)
ROW = re.compile(r"^\| `(tagfield/[\w/]+\.h)` \| +\S", re.MULTILINE)


def public_headers(root):
    """Paths of the installed headers, as listed in the rooms' CMakeLists.txt."""
    found = []
    for path in sorted(root.glob("tagfield/*/CMakeLists.txt")):
        for names in LIST.findall(path.read_text(encoding="utf-8")):
            found += [f"tagfield/{path.parent.name}/{name}" for name in names.split()]
    return found


def included_by(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def header_faults(root, public):
    for name in public:
        if not (root / name).is_file():
            yield f"{name}: is public, but not there"
        elif "internal" in name.split("/") or "test" in name.split("/"):
            yield f"{name}: is public, and for its room alone"
        else:
            for other in included_by(root / name):
                if other not in public:
                    yield f"{name}: is public, but includes {other}"
    for path in root.glob("tagfield/**/*.h"):
        name = str(path.relative_to(root))
        if "/internal/" in name or "/test/" in name:
            continue
        for other in included_by(path):
            if "/internal/" in other:
                yield f"{name}: others include it, so it must not include {other}"


def example_faults(root, public):
    for path in sorted(root.glob("examples/**/*.cc")):
        for other in included_by(path):
            if other not in public:
                yield f"{path.relative_to(root)}: an example includes {other}, which is not installed"


def list_faults(root, public):
    """Violations of the rule that docs/api.md lists each header once, with its purpose."""
    listed = ROW.findall((root / "docs/api.md").read_text(encoding="utf-8"))
    for name in sorted(set(public) - set(listed)):
        yield f"docs/api.md: {name} is missing"
    for name in sorted(set(listed) - set(public)):
        yield f"docs/api.md: {name} is not installed"
    for name in sorted({name for name in listed if listed.count(name) > 1}):
        yield f"docs/api.md: {name} stands there twice"


def faults(root):
    public = public_headers(root)
    return [fault for rule in (header_faults, example_faults, list_faults)
            for fault in rule(root, public)]


# --- Detection of planted faults ------------------------------------------------------------------

GOOD = {
    "tagfield/base/CMakeLists.txt": "tagfield_room(base\n  SOURCES a.cc\n  PUBLIC_HEADERS a.h\n"
                                    "    part/b.h\n  LINKS Threads::Threads)\n",
    "tagfield/stream/CMakeLists.txt": "tagfield_public_headers(stream c.h)\n",
    "tagfield/base/a.h": '#include <vector>\n#include "tagfield/base/part/b.h"\n',
    "tagfield/base/part/b.h": "\n",
    "tagfield/base/shared.h": '#include "tagfield/base/a.h"\n',
    "tagfield/base/internal/d.h": '#include "tagfield/base/shared.h"\n',
    "tagfield/stream/c.h": '#include "tagfield/base/a.h"\n',
    "examples/01/one.cc": '#include "tagfield/stream/c.h"\n',
    "docs/api.md": "| `tagfield/base/a.h` | errors |\n| `tagfield/base/part/b.h` | parts |\n"
                   "| `tagfield/stream/c.h` | streams |\n",
}
PLANTED = (  # a file, its content, part of the expected message
    ("tagfield/stream/c.h", '#include "tagfield/base/shared.h"\n', "includes tagfield/base/shared.h"),
    ("tagfield/stream/CMakeLists.txt", "tagfield_public_headers(stream c.h e.h)\n", "not there"),
    ("tagfield/base/CMakeLists.txt", "tagfield_room(base PUBLIC_HEADERS a.h part/b.h internal/d.h)\n",
     "for its room alone"),
    ("tagfield/base/shared.h", '#include "tagfield/base/internal/d.h"\n', "must not include"),
    ("examples/01/one.cc", '#include "tagfield/base/shared.h"\n', "an example includes"),
    ("docs/api.md", "| `tagfield/base/a.h` | errors |\n| `tagfield/stream/c.h` | streams |\n",
     "b.h is missing"),
    ("docs/api.md", GOOD["docs/api.md"] + "| `tagfield/base/shared.h` | more |\n", "not installed"),
    ("docs/api.md", GOOD["docs/api.md"] + "| `tagfield/base/a.h` | more |\n", "twice"),
)


def faults_of_tree(files):
    with tempfile.TemporaryDirectory(prefix="public_headers_test-") as folder:
        for name, text in files.items():
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return faults(pathlib.Path(folder))


def blind_spots():
    """Planted faults that this test does not detect."""
    for fault in faults_of_tree(GOOD):
        yield f"complains of a good tree: {fault}"
    for name, text, says in PLANTED:
        found = faults_of_tree({**GOOD, name: text})
        if not any(says in fault for fault in found):
            yield f"{name} with {text!r} gives {found}, expected one with {says!r}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    count = len(public_headers(root))
    found = [*faults(root), *blind_spots()]
    if count < 30:
        found.append(f"only {count} public headers were found under {root}")
    for fault in found:
        print(fault)
    print(f"{count} public headers and {len(PLANTED)} planted faults, {len(found)} failures")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
