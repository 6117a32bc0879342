#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""clang-tidy has nothing to say of any source that is built, tests excepted.

    tidy_test.py SOURCE_DIR BUILD_DIR [--part N/OF] [--since FILE]

With --since only what changed since the commit that FILE names: scripts/lint looked at all then. That is
every source that changed, and of headers that changed a source each that includes it. All where .clang-tidy
changed, too, or where there is no such commit, as in a shallow clone.

Most of its time goes into headers that many sources include. So it looks at several sources at a time,
included one after the other in one file; where those don't go together, at each by itself.
"""

import argparse
import concurrent.futures
import dataclasses
import functools
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from changes import changed_since  # noqa: E402

RULES = {".clang-tidy", "tests/structure/tidy_test.py", "tests/structure/changes.py"}
SKIPPED = 77
MOST_SOURCES = 48  # in a unit; more take more than a gigabyte of memory
PLANTED = "int f(int a) { int b; if (a) b = a; return b; }\n"
COMPLAINT = "planted.cc:1:20: error: variable 'b' is not initialized"
# Defines what other sources define, in builds without them.
STAND_INS = ("adapters/ros1/bag_refusal.cc",)
# Templates that nobody uses are not read, which are most of those in libraries' headers.
READ_LESS = "-fdelayed-template-parsing"
FAILS_TO_COMPILE = "[clang-diagnostic-error]"
DEFINITION = re.compile(r"(?:struct|class|union|enum class|enum) (\w+)|.*?([\w:]+)\s*[({=;\[]")
ENTRY = re.compile(r'^(?:extern "C" )?int (main|LLVMFuzzerTestOneInput)\(|^(BENCHMARK_MAIN)\(', re.MULTILINE)
ALIAS = re.compile(r"using (\w+) = (.*)")
HEADER = re.compile(r'^#include "(.*)"$', re.MULTILINE)
TYPE = re.compile(r"^(?:struct|class|union|enum class|enum|using) (\w+)", re.MULTILINE)


@dataclasses.dataclass
class Unit:
    """Sources that are looked at together."""

    flags: list  # all that any of them is compiled with
    sources: list
    names: dict  # what they define for themselves: name -> where, or what an alias stands for
    types: set  # names of the project's types that they see


# --- What is built --------------------------------------------------------------------------------

def is_looked_at(name):
    return not name.startswith(("..", "build/", "tests/")) and "/test/" not in name


def flags_of(entry):
    """Standard, definitions and folders of an entry of the compile database."""
    words = iter(shlex.split(entry["command"]))
    flags = []
    for word in words:
        if word == "-isystem":
            flags.append(f"-isystem{os.path.join(entry['directory'], next(words))}")
        elif word.startswith("-I"):
            flags.append(f"-I{os.path.join(entry['directory'], word[2:])}")
        elif word.startswith(("-std=", "-D")):
            flags.append(word)
    return flags


def compiled_by(entry):
    """Paths of the sources of an entry of the compile database: several in a unity build."""
    path = os.path.realpath(os.path.join(entry["directory"], entry["file"]))
    if "Unity" not in path.split(os.sep) or not os.path.exists(path):
        return [path]
    return [os.path.realpath(name) for name in HEADER.findall(pathlib.Path(path).read_text(encoding="utf-8"))]


def sources_of(database, top):
    """Flags of each of the project's sources, by its path."""
    found = {}
    for entry in json.loads(database.read_text(encoding="utf-8")):
        for path in compiled_by(entry):
            if is_looked_at(os.path.relpath(path, top)) and os.path.exists(path):
                found.setdefault(path, flags_of(entry))
    return found


# --- What changed ---------------------------------------------------------------------------------

def including(header, sources, top):
    """The source that includes it, best that of its own name, or that includes a header that does; None
    if none does."""
    users = [path for path in sorted(sources)
             if header in HEADER.findall(pathlib.Path(path).read_text(encoding="utf-8"))]
    own = [path for path in users if pathlib.Path(path).stem == pathlib.Path(header).stem]
    if users:
        return (own or users)[0]
    through = [str(path.relative_to(top)) for folder in ("tagfield", "adapters", "apps")
               for path in sorted((top / folder).rglob("*.h"))
               if header in HEADER.findall(path.read_text(encoding="utf-8"))]
    found = (including(other, sources, top) for other in through if other != header)
    return next(filter(None, found), None)


def those_of(sources, names, top):
    """Of the sources those that changed, and one for each header that did."""
    chosen = {path for path in sources if os.path.relpath(path, top) in names}
    for name in names:
        if name.endswith(".h") and (top / name).exists():
            chosen.add(including(name, sources, top))
    return {path: flags for path, flags in sources.items() if path in chosen}


def looked_at(sources, since, top):
    """Those that are to be looked at, and why."""
    if since is None:
        return sources, "all"
    commit = since.read_text(encoding="utf-8").split()[0]
    names = changed_since(commit, top, RULES)
    if names is None:
        return sources, f"all, as what changed since {commit[:12]} can't be told or the rules changed"
    return those_of(sources, names, top), f"changed since {commit[:12]}"


# --- Units ----------------------------------------------------------------------------------------

def is_own(name):
    """Not a member, a name of another namespace, or what only looks like a name."""
    return "::" not in name and name not in ("static_assert", "BENCHMARK")


def own_names(path):
    """What a source defines in its unnamed namespaces, and where a program starts; good enough to guess
    what goes together."""
    text = pathlib.Path(path).read_text(encoding="utf-8")
    names = {found.group(1) or "main": path for found in ENTRY.finditer(text)}
    for block in re.findall(r"^namespace \{$(.*?)^\}  // namespace$", text, re.DOTALL | re.MULTILINE):
        for line in block.split("\n"):
            alias = ALIAS.match(line)
            definition = DEFINITION.match(line)
            if alias:
                names[alias.group(1)] = alias.group(2)
            elif definition and re.match(r"\w", line):
                names[definition.group(1) or definition.group(2)] = path
    return {name: what for name, what in names.items() if is_own(name)}


@functools.cache
def seen_types(path, top):
    """Types that a file or the project's headers that it includes declare outside of all else."""
    path = pathlib.Path(path)
    if not path.exists():
        return frozenset()  # made by the build
    text = path.read_text(encoding="utf-8")
    found = set(TYPE.findall(text)) if path.suffix == ".h" else set()
    return frozenset(found.union(*(seen_types(top / name, top) for name in HEADER.findall(text))))


def go_together(one, other):
    def standard(unit):
        return [flag for flag in unit.flags if flag.startswith("-std=")]
    return (len(one.sources) + len(other.sources) <= MOST_SOURCES and
            standard(one) == standard(other) and
            all(one.names[name] == other.names[name] for name in one.names.keys() & other.names) and
            not one.types & other.names.keys() and not other.types & one.names.keys())


def units_of(sources, top):
    """Each source in the first unit that it goes together with."""
    units = []
    for path, flags in sorted(sources.items()):
        alone = Unit(flags, [path], own_names(path), set(seen_types(path, top)))
        unit = next((unit for unit in units if go_together(unit, alone)), None)
        if path.endswith(STAND_INS):
            unit = None
        if unit is None:
            units.append(alone)
            continue
        unit.flags += [flag for flag in flags if flag not in unit.flags]
        unit.sources.append(path)
        unit.names.update(alone.names)
        unit.types |= alone.types
    return units


def part_of(units, part, of):
    """Those of one of so many parts, each of about as many sources."""
    parts = [[] for _ in range(of)]
    for unit in sorted(units, key=lambda unit: -len(unit.sources)):
        min(parts, key=lambda units: sum(len(unit.sources) for unit in units)).append(unit)
    return parts[part - 1]


# --- clang-tidy -----------------------------------------------------------------------------------

class Tidy:
    """Runs it; files are made in a folder."""

    def __init__(self, top, folder):
        self.folder = pathlib.Path(folder)
        config = top / ".clang-tidy"
        headers = re.search("^HeaderFilterRegex: '(.*)'$", config.read_text(encoding="utf-8"),
                            re.MULTILINE).group(1)
        self.command = ["clang-tidy", "--quiet", f"--config-file={config}",
                        f"--header-filter=({headers}|\\.cc$)"]

    def said_of(self, path, flags):
        done = subprocess.run([*self.command, path, "--", READ_LESS, *flags], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False)
        return (done.stdout or done.stderr) if done.returncode else ""

    def look_at(self, unit):
        """What it says of a unit, "" where that is nothing."""
        with tempfile.NamedTemporaryFile("w", dir=self.folder, suffix=".cc") as file:
            for path in unit.sources:
                file.write(f'#include "{path}"  // NOLINT(bugprone-suspicious-include)\n')
            file.flush()
            said = self.said_of(file.name, unit.flags)
        if FAILS_TO_COMPILE not in said or len(unit.sources) == 1:
            return said
        print(f"not together: {' '.join(unit.sources)}")
        middle = len(unit.sources) // 2
        return "".join(self.look_at(dataclasses.replace(unit, sources=sources))
                       for sources in (unit.sources[:middle], unit.sources[middle:]))


def notices(tidy):
    """Whether it says something of a fault among faultless sources."""
    for name, text in (("good.cc", "int g() { return 1; }\n"), ("planted.cc", PLANTED)):
        (tidy.folder / name).write_text(text, encoding="utf-8")
    sources = [str(tidy.folder / name) for name in ("good.cc", "planted.cc")]
    return COMPLAINT in tidy.look_at(Unit(["-std=c++20"], sources, {}, set()))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--part", default="1/1", help="of the units, as 2/3")
    parser.add_argument("--since", type=pathlib.Path, help="names the commit before what changed")
    arguments = parser.parse_args()
    if shutil.which("clang-tidy") is None:
        print("skipped: clang-tidy is not installed")
        sys.exit(SKIPPED)
    top = arguments.source.resolve()
    sources = sources_of(arguments.build / "compile_commands.json", top)
    if len(sources) < 50:
        sys.exit(f"only {len(sources)} sources in the compile database: looked in the wrong place?")
    chosen, why = looked_at(sources, arguments.since, top)
    part, of = map(int, arguments.part.split("/"))
    units = part_of(units_of(chosen, top), part, of)
    with tempfile.TemporaryDirectory(prefix="tidy_test-") as folder:
        tidy = Tidy(top, folder)
        if not notices(tidy):
            sys.exit("clang-tidy takes anything: is .clang-tidy there?")
        with concurrent.futures.ThreadPoolExecutor(1 if of > 1 else os.cpu_count()) as pool:
            said = list(filter(None, pool.map(tidy.look_at, units)))
    print("\n".join(said))
    print(f"clang-tidy: {sum(len(unit.sources) for unit in units)} of {len(sources)} sources ({why}) in "
          f"{len(units)} units, complaints about {len(said)} units")
    sys.exit(1 if said else 0)


if __name__ == "__main__":
    main()
