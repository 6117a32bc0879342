#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""clang-tidy has no findings in the sources that are built, except for tests.

    tidy_test.py SOURCE_DIR BUILD_DIR [--part N/OF] [--since FILE]

With --since, checks only changes since the commit named in FILE (when scripts/lint checked all): every
changed source, and for each changed header one source that includes it. Checks all if .clang-tidy changed,
too, or if there is no such commit, as in a shallow clone.

Most of the time is spent in headers that many sources include. Therefore several sources are checked at
once, included one after another in one file; if these do not compile together, they are checked separately.
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
MOST_SOURCES = 48  # maximum per unit; more need over a gigabyte of memory
PLANTED = "int f(int a) { int b; if (a) b = a; return b; }\n"
COMPLAINT = "planted.cc:1:20: error: variable 'b' is not initialized"
# Stubs that define the same names as other sources, for builds without those.
STAND_INS = ("adapters/bags/bag_refusal.cc",)
# Skips the parsing of unused templates, which are most of those in library headers.
READ_LESS = "-fdelayed-template-parsing"
FAILS_TO_COMPILE = "[clang-diagnostic-error]"
DEFINITION = re.compile(r"(?:struct|class|union|enum class|enum) (\w+)|.*?([\w:]+)\s*[({=;\[]")
ENTRY = re.compile(r'^(?:extern "C" )?int (main|LLVMFuzzerTestOneInput)\(|^(BENCHMARK_MAIN)\(', re.MULTILINE)
ALIAS = re.compile(r"using (\w+) = (.*)")
HEADER = re.compile(r'^#include "(.*)"$', re.MULTILINE)
TYPE = re.compile(r"^(?:struct|class|union|enum class|enum|using) (\w+)", re.MULTILINE)


@dataclasses.dataclass
class Unit:
    """Sources that are checked together."""

    flags: list  # union of their compiler flags
    sources: list
    names: dict  # names that they define locally: name -> file, or the target of an alias
    types: set  # names of the project's types that they include


# --- What is built --------------------------------------------------------------------------------

def is_looked_at(name):
    return not name.startswith(("..", "build/", "tests/")) and "/test/" not in name


def flags_of(entry):
    """Language standard, definitions and include folders of an entry of the compile database."""
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
    """Paths of the sources of an entry of the compile database; several in a unity build."""
    path = os.path.realpath(os.path.join(entry["directory"], entry["file"]))
    if "Unity" not in path.split(os.sep) or not os.path.exists(path):
        return [path]
    return [os.path.realpath(name) for name in HEADER.findall(pathlib.Path(path).read_text(encoding="utf-8"))]


def sources_of(database, top):
    """Flags of each of the project's sources, by path."""
    found = {}
    for entry in json.loads(database.read_text(encoding="utf-8")):
        for path in compiled_by(entry):
            if is_looked_at(os.path.relpath(path, top)) and os.path.exists(path):
                found.setdefault(path, flags_of(entry))
    return found


# --- What changed ---------------------------------------------------------------------------------

def including(header, sources, top):
    """A source that includes the header directly, preferably that with the same name, or indirectly;
    None if there is none."""
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
    """The changed sources, and one source for each changed header."""
    chosen = {path for path in sources if os.path.relpath(path, top) in names}
    for name in names:
        if name.endswith(".h") and (top / name).exists():
            chosen.add(including(name, sources, top))
    return {path: flags for path, flags in sources.items() if path in chosen}


def looked_at(sources, since, top):
    """The sources to check, and the reason in words."""
    if since is None:
        return sources, "all"
    commit = since.read_text(encoding="utf-8").split()[0]
    names = changed_since(commit, top, RULES)
    if names is None:
        return sources, f"all, as what changed since {commit[:12]} can't be told or the rules changed"
    return those_of(sources, names, top), f"changed since {commit[:12]}"


# --- Units ----------------------------------------------------------------------------------------

def is_own(name):
    """Whether it is a locally defined name: not a member, not qualified, not a keyword or macro."""
    return "::" not in name and name not in ("static_assert", "BENCHMARK")


def own_names(path):
    """Names that a source defines in unnamed namespaces, and entry points; a heuristic for which sources
    can be compiled together."""
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
    """Types at namespace scope in a file, if it is a header, and in project headers that it includes."""
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
    """Assigns each source to the first unit with which it can be compiled."""
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
    """The units of one of `of` parts with about equal numbers of sources."""
    parts = [[] for _ in range(of)]
    for unit in sorted(units, key=lambda unit: -len(unit.sources)):
        min(parts, key=lambda units: sum(len(unit.sources) for unit in units)).append(unit)
    return parts[part - 1]


# --- clang-tidy -----------------------------------------------------------------------------------

class Tidy:
    """Runs clang-tidy; its input files are written to a folder."""

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
        """Findings in a unit, or ""."""
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
    """Whether a planted fault among faultless sources is found."""
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
