#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Collects the pages of the site in a folder: those of docs/ and those generated from the sources.

    stage.py SOURCE_DIR TAGFIELD STAGE_DIR [--gallery yes|no]

The site's menu has the order of the links in docs/index.md.
"""

import argparse
import itertools
import pathlib
import re
import shutil

import gallery
import reference

LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")
# Pages from elsewhere in the repository, with their names on the site.
ELSEWHERE = {
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "benchmarks/BENCHMARK.md": "benchmark.md",
    "examples/03_own_csv/README.md": "example_own_csv.md",
}


def in_code(text):
    """Whether each line is code: fenced, or indented after an empty line."""
    fenced = indented = False
    empty = True
    for line in text.split("\n"):
        if line.lstrip().startswith("```"):
            fenced = not fenced
            yield True
            continue
        if not fenced:
            indented = line.startswith("    ") and (empty or indented) or (indented and not line.strip())
        empty = not line.strip()
        yield fenced or indented


class Stage:
    def __init__(self, top, folder):
        self.top, self.folder = top, folder

    def target(self, page, target):
        """A link's target on the site, or None if only the link's text is kept."""
        if re.match(r"[a-z]+:", target) or target.startswith("#"):
            return target
        name, _, anchor = target.partition("#")
        path = (page.parent / name).resolve().relative_to(self.top)
        anchor = f"#{anchor}" if anchor else ""
        if str(path) in ELSEWHERE:
            return ELSEWHERE[str(path)] + anchor
        if str(path) == "README.md":
            return "index.md"
        if path.parts[0] == "docs":
            return "/".join(path.parts[1:]) + anchor
        if (self.top / path).is_dir():
            return None
        copy = self.folder / "files" / path
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(self.top / path, copy)
        return f"files/{path}"

    def title(self, target):
        """The title of a page, for links whose text is its file name."""
        name = target.partition("#")[0]
        sources = {page: self.top / path for path, page in ELSEWHERE.items()}
        source = sources.get(name, self.top / "docs" / name)
        return source.read_text(encoding="utf-8").split("\n", 1)[0].lstrip("# ") if source.exists() else name

    def page(self, page, name):
        def replaced(match):
            target = self.target(page, match[3])
            text = self.title(target) if match[2].endswith(".md") and target else match[2]
            return text if target is None else f"{match[1]}[{text}]({target})"

        text = page.read_text(encoding="utf-8")
        parts = itertools.groupby(zip(text.split("\n"), in_code(text)), key=lambda pair: pair[1])
        written = []
        for code, pairs in parts:
            part = "\n".join(line for line, _ in pairs)
            written.append(part if code else LINK.sub(replaced, part))
        (self.folder / name).write_text("\n".join(written), encoding="utf-8")


def menu(index):
    """Tables of contents from the links in docs/index.md, one per section."""
    for section in re.split(r"^## ", index, flags=re.MULTILINE)[1:]:
        title = section.split("\n", 1)[0]
        pages = [f"{text} <{name.removesuffix('.md')}>" for mark, text, name in LINK.findall(section)
                 if not mark and name.endswith(".md") and "/" not in name]
        if pages:
            yield "\n".join(["", "```{toctree}", ":hidden:", f":caption: {title}", "", *pages, "```", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("tagfield", type=pathlib.Path)
    parser.add_argument("stage", type=pathlib.Path)
    parser.add_argument("--gallery", choices=["yes", "no"], default="yes")
    arguments = parser.parse_args()
    top = arguments.source.resolve()
    folder = arguments.stage
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    stage = Stage(top, folder)
    for item in (top / "docs").iterdir():
        if item.suffix == ".md":
            stage.page(item, item.name)
        elif item.is_file():
            shutil.copyfile(item, folder / item.name)
    shutil.copytree(top / "docs/images", folder / "images")
    for path, name in ELSEWHERE.items():
        stage.page(top / path, name)
    reference.write_pages(top, arguments.tagfield, folder)
    gallery.write_page(top, arguments.tagfield, folder, draw_pictures=arguments.gallery == "yes")
    index = (folder / "index.md").read_text(encoding="utf-8")
    (folder / "index.md").write_text(index + "".join(menu(index)), encoding="utf-8")


if __name__ == "__main__":
    main()
