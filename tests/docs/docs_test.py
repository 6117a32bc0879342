#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The pages of docs/ and the README: what they name is there.

    docs_test.py --tagfield PROGRAM --source SOURCE_DIR

Links and their anchors lead somewhere; docs/index.md, which the site's menu is made of, has every page;
commands and options in code exist, and the site's reference has all of them; every key that the sources
read from a file is described. Then the test looks whether it would notice each.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs/site"))
import keys  # noqa: E402
import reference  # noqa: E402
import stage  # noqa: E402

# Pages that docs/site makes.
MADE = {"gallery.md", "commands.md", "all_keys.md", "messages.md", "cpp_api.md", "python_api.md"} | set(
    stage.ELSEWHERE.values())
README_WORDS = 700
COMMAND = re.compile(r"(?:^|[\s;&|(])(?:\S*bin/)?tagfield ([a-z]\w*)\b([^|&;#`)\n]*)")
OPTION = re.compile(r"(?<![\w-])(--[a-z][a-z0-9-]*)")
# Options of all commands, and words after `tagfield` that are no commands.
ALWAYS = {"--help"}


def pages(top):
    return [top / "README.md", top / "CONTRIBUTING.md", top / "CHANGELOG.md", *sorted((top / "docs").glob("*.md")),
            *sorted((top / "benchmarks").glob("*.md")), *sorted((top / "examples").glob("*/*.md"))]


def slug(title):
    """As GitHub and MyST make anchors of headings."""
    title = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title).replace("`", "")
    return re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")


def anchors(page):
    text = page.read_text(encoding="utf-8")
    titles = (line.lstrip("#") for line, code in zip(text.split("\n"), stage.in_code(text))
              if line.startswith("#") and not code)
    return {slug(title) for title in titles}


def prose_of(page):
    """A page's text without its code blocks."""
    text = page.read_text(encoding="utf-8")
    return "\n".join("" if code else line for line, code in zip(text.split("\n"), stage.in_code(text)))


def link_faults(top):
    for page in pages(top):
        if not page.exists():
            continue
        for _, _, target in stage.LINK.findall(re.sub(r"`[^`\n]*`", "`", prose_of(page))):
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            where = page.relative_to(top)
            if name in MADE and page.parent.name == "docs":
                continue
            other = (page.parent / name).resolve() if name else page
            if not other.exists():
                yield f"{where}: links to {target}, which is not there"
            elif anchor and other.suffix == ".md" and anchor not in anchors(other):
                yield f"{where}: links to {target}, but {other.name} has no such heading"


def menu_faults(top):
    """Every page of docs/ is in the menu, and so is every page that is made."""
    text = (top / "docs/index.md").read_text(encoding="utf-8")
    linked = {pathlib.Path(target.partition("#")[0]).name for _, _, target in stage.LINK.findall(text)}
    linked |= {stage.ELSEWHERE[path] for path in stage.ELSEWHERE if f"../{path}" in text}
    for name in sorted({page.name for page in (top / "docs").glob("*.md")} - {"index.md"} - linked):
        yield f"docs/index.md: does not link to {name}"
    for name in sorted(MADE - linked):
        yield f"docs/index.md: does not link to {name}, which docs/site makes"


def code_of(page):
    """The code of a page, blocks with their continued lines joined, and inline code."""
    text = page.read_text(encoding="utf-8")
    blocks = "\n".join(line if code else "" for line, code in zip(text.split("\n"), stage.in_code(text)))
    yield from re.sub(r"\\\n\s*", " ", blocks).split("\n")
    yield from re.findall(r"`([^`\n]+)`", prose_of(page))


def command_faults(top, options):
    """`options`: of each command."""
    for page in pages(top):
        if not page.exists():
            continue
        for line in code_of(page):
            if line.lstrip().startswith(("tagfield:", "#")):
                continue
            for command, rest in COMMAND.findall(line):
                where = f"{page.relative_to(top)}: tagfield {command}"
                if command not in options:
                    yield f"{where}: is no command"
                    continue
                for option in OPTION.findall(rest):
                    if option not in options[command]:
                        yield f"{where}: has no option {option}"


def script_faults(top):
    for page in pages(top):
        if not page.exists():
            continue
        for line in code_of(page):
            for name in re.findall(r"(?:^|\s)(scripts/[\w.-]+)", line):
                if not (top / name).exists():
                    yield f"{page.relative_to(top)}: names {name}, which is not there"


def key_faults(top):
    for name, entry in sorted(keys.keys(top).items()):
        if not keys.pages_of(top, entry, name):
            yield (f"{entry['sources'][0]}: reads the key '{name}', which none of "
                   f"{', '.join(f'docs/{page}.md' for page in entry['pages'])} describes")


def readme_faults(top):
    words = len((top / "README.md").read_text(encoding="utf-8").split())
    if words >= README_WORDS:
        yield f"README.md: has {words} words, not under {README_WORDS}"


def options_of(tagfield):
    listed = reference.commands_of(reference.help_of(tagfield))
    return {name: ALWAYS | set(OPTION.findall(reference.help_of(tagfield, name))) for name in listed}


def reference_faults(tagfield, options):
    """The page of commands that the site has is made of help texts: it has each option."""
    page = reference.commands_page(tagfield)
    sections = dict(re.findall(r"^## (\S+)\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL))
    for command, names in options.items():
        rows = set(re.findall(r"^\| `(--[\w-]+)` ", sections.get(command, ""), re.MULTILINE))
        if command not in sections:
            yield f"docs/site/reference.py: leaves out the command {command}"
        for name in sorted(rows - names):
            yield f"docs/site/reference.py: {command} has no option {name}"
        listed = re.search(r"\nOptions:\n(.*?)(?:\n\n|\Z)", reference.help_of(tagfield, command), re.DOTALL)[1]
        for name in sorted(set(re.findall(r"^  (--[a-z][\w-]*)", listed, re.MULTILINE)) - rows):
            yield f"docs/site/reference.py: {command} --help has {name}, the page has not"


def faults(top, options):
    return [*link_faults(top), *menu_faults(top), *command_faults(top, options), *script_faults(top),
            *readme_faults(top), *key_faults(top)]


GOOD = {
    "README.md": "# T\n\n[docs](docs/index.md)\n",
    "CONTRIBUTING.md": "# C\n",
    "CHANGELOG.md": "# C\n",
    "benchmarks/BENCHMARK.md": "# B\n",
    "examples/03_own_csv/README.md": "# E\n",
    "docs/a.md": "# A\n\n## Two words\n\n    tagfield run x --seed 1\n",
    "docs/index.md": "# T\n\n## S\n\n" + "".join(f"- [x]({name})\n" for name in sorted(MADE)) + "- [a](a.md#two-words)\n",
}
BAD = [
    ("docs/a.md", "[x](b.md)\n", "links to b.md"),
    ("docs/a.md", "[x](index.md#nothing)\n", "no such heading"),
    ("docs/b.md", "# B\n", "does not link to b.md"),
    ("docs/index.md", GOOD["docs/index.md"].replace("[x](gallery.md)", ""), "gallery.md, which docs/site makes"),
    ("docs/a.md", "# A\n\n## Two words\n\n    tagfield walk x\n", "is no command"),
    ("docs/a.md", "# A\n\n## Two words\n\n    tagfield run x \\\n      --sed 1\n", "has no option --sed"),
    ("docs/a.md", "# A\n\n## Two words\n\n`tagfield run --sed 1`\n", "has no option --sed"),
    ("docs/a.md", "# A\n\n## Two words\n\n    scripts/nothing\n", "scripts/nothing, which is not there"),
    ("README.md", "word " * README_WORDS, "not under"),
    ("tagfield/scenario/x.cc", 'map.number("colour", 1.0)', "reads the key 'colour'"),
]


def write(folder, files):
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def missed():
    """Faults that the test would not notice."""
    options = {"run": {"--seed"}}
    with tempfile.TemporaryDirectory() as temporary:
        good = pathlib.Path(temporary).resolve() / "good"
        write(good, GOOD)
        yield from (f"a good tree: {fault}" for fault in faults(good, options))
        for number, (name, text, expected) in enumerate(BAD):
            folder = good.parent / str(number)
            write(folder, {**GOOD, name: text})
            found = faults(folder, options)
            if not any(expected in fault for fault in found):
                yield f"{name} with {text[:60]!r}: expected '{expected}', found {found}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--tagfield", required=True)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--build")
    arguments = parser.parse_args()
    top = arguments.source.resolve()
    options = options_of(arguments.tagfield)
    found = [*faults(top, options), *reference_faults(arguments.tagfield, options), *missed()]
    for fault in found:
        print(fault)
    if found:
        sys.exit(1)
    print(f"{len(pages(top))} pages, {len(keys.keys(top))} keys")


if __name__ == "__main__":
    main()
