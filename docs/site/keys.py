# SPDX-License-Identifier: Apache-2.0
"""The keys of user files that the sources read, and the pages that describe them."""

import pathlib
import re

# Sources that read YAML, and the pages of which at least one has to describe their keys.
SOURCES = {
    "tagfield/scenario/*.cc": ["scenario", "link_budget", "plan", "datasets", "files", "reader", "calibration"],
    "tagfield/scenario/internal/*.cc": ["scenario", "tracking", "plan", "link_budget", "coverage"],
    "tagfield/settings/*.cc": ["radio_settings"],
    "tagfield/localization/*/*.cc": ["methods"],
    "tagfield/localization/*.cc": ["methods"],
    "tagfield/experiment/bench/*.cc": ["bench", "sweep"],
    "tagfield/experiment/sweep/*.cc": ["sweep"],
    "tagfield/events/*.cc": ["events"],
}
ASKED = re.compile(r'\b(?:map|suite|values|table|laser|yaml)\w*\.(?:has|at|number|text|boolean|list|whole_number)'
                   r'\(\s*"(\w+)"')
# A row in a table of settings: {"key", "unit", …
SETTING = re.compile(r'\{\s*"([a-z]\w*_?\w*)",\s*"[^"]*",')
OPTION = re.compile(r'\{\{\s*"([a-z]\w+)"')


def keys(top):
    """All keys that the sources read: {key: {"sources": files, "pages": pages that may describe it}}."""
    found = {}
    for pattern, pages in SOURCES.items():
        for path in sorted(pathlib.Path(top).glob(pattern)):
            if path.parent.name == "test":
                continue
            text = path.read_text(encoding="utf-8")
            names = set(ASKED.findall(text))
            if "/settings/" in str(path) or "/localization/" in str(path):
                names |= set(SETTING.findall(text)) | set(OPTION.findall(text))
            for name in names:
                entry = found.setdefault(name, {"sources": [], "pages": []})
                entry["sources"].append(str(path.relative_to(top)))
                entry["pages"] += [page for page in pages if page not in entry["pages"]]
    return found


def describes(text, key):
    """Whether a page has the key in inline code: alone, as part of a path, or in an example."""
    return re.search(rf"`[^`\n]*\b{key}\b[^`\n]*`", text) is not None


def pages_of(top, entry, key):
    paths = {page: pathlib.Path(top) / f"docs/{page}.md" for page in entry["pages"]}
    return [page for page, path in paths.items()
            if path.exists() and describes(path.read_text(encoding="utf-8"), key)]


if __name__ == "__main__":
    import sys

    for name, where in sorted(keys(pathlib.Path(sys.argv[1])).items()):
        print(name, pages_of(sys.argv[1], where, name) or f"UNDOCUMENTED {where['sources']}")
