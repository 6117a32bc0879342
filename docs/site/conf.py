# SPDX-License-Identifier: Apache-2.0
"""Sphinx configuration. scripts/docs builds the site from the pages that stage.py collects before."""

import os
import pathlib
import re

from docutils import nodes
from sphinx.transforms import SphinxTransform

TOP = pathlib.Path(__file__).resolve().parents[2]
OUT = pathlib.Path(os.environ.get("TAGFIELD_DOCS_OUT", TOP / "build/docs"))

project = "Tagfield"
copyright = "the Tagfield authors, Apache-2.0"  # The name is Sphinx's.
html_title = "Tagfield"
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
try:
    import sphinx_copybutton  # noqa: F401

    extensions.append("sphinx_copybutton")
except ImportError:
    pass

exclude_patterns = ["files"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # Generated pages skip heading levels on purpose.

breathe_projects = {"tagfield": str(OUT / "doxygen/xml")}
breathe_default_project = "tagfield"
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["tagfield.css", "katex.min.css"]
html_js_files = ["katex.js", "formulas.js"]
# Debian's KaTeX, so that pages need no network access. TAGFIELD_KATEX names another copy.
KATEX = pathlib.Path(os.environ.get("TAGFIELD_KATEX", "/usr/share/javascript/katex"))
html_static_path.append(str(KATEX))
html_show_sphinx = False
html_copy_source = False
# Debian's build of furo lacks the dark colours and the style of the theme switch (static/tagfield.css).
html_theme_options = {
    "navigation_with_keys": True,
    "dark_css_variables": {
        "color-foreground-primary": "#ffffffcc",
        "color-foreground-secondary": "#9ca0a5",
        "color-foreground-muted": "#81868d",
        "color-foreground-border": "#666666",
        "color-background-primary": "#131416",
        "color-background-secondary": "#1a1c1e",
        "color-background-hover": "#1e2124ff",
        "color-background-hover--transparent": "#1e212400",
        "color-background-border": "#303335",
        "color-background-item": "#444444",
        "color-card-background": "#18181a",
        "color-card-marginals-background": "#1e2124ff",
        "color-brand-primary": "#2b8cee",
        "color-brand-content": "#58a6ff",
        "color-highlighted-background": "#083563",
        "color-highlight-on-target": "#333300",
        "color-api-keyword": "#9ca0a5",
        "color-problematic": "#ee5151",
    },
}
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True
pygments_style = "default"
pygments_dark_style = "monokai"

# Language of a code block that states none, by its beginning.
LANGUAGES = [
    (r"\s*<", "xml"),
    (r">>> ", "pycon"),
    (r"(import|from|@|run|runs|reads|link|sim|scenario|hall)\b.*[=(.]", "python"),
    (r"\$ ", "console"),
    (r"(tagfield|build/|scripts/|examples/|benchmarks/|cmake|cd|curl|export|sudo|rviz|roslaunch|rosbag|ros2|gz|ln|for"
     r"|source|pip|python3|mosquitto_sub|git|sqlite3|PYTHONPATH=|ctest|/usr/bin|roscore|mpirun)\b", "bash"),
    (r"- \{?[a-z_]+:|[a-z_]+:( |$)", "yaml"),
    (r"SELECT|--", "sql"),
]


class BlockLanguages(SphinxTransform):
    """Guesses the language of indented code blocks, which have none in Markdown."""

    default_priority = 450

    def apply(self):
        for block in list(self.document.findall(nodes.literal_block)):
            if block.get("language") == "math":  # A formula in the form that GitHub renders, too.
                formula = nodes.math_block(block.astext(), block.astext(), nowrap=False, number=None)
                block.replace_self(formula)
                continue
            if block.get("language", "none") in ("none", "default", ""):
                first = block.astext().split("\n", 1)[0]
                matches = (name for begin, name in LANGUAGES if re.match(begin, first))
                block["language"] = next(matches, "text")
            block["force"] = True


class WideTables(SphinxTransform):
    """Wraps tables in boxes that scroll on their own, so that the page does not have to."""

    default_priority = 460

    def apply(self):
        for table in list(self.document.findall(nodes.table)):
            box = nodes.container(classes=["table-box"])
            table.replace_self(box)
            box += table


FIELD = re.compile(r"(\w+(?:, \w+)*): +(\S.*)")


def docstring(_app, _what, _name, _object, _options, lines):
    """Converts field descriptions ("name: description") to lists and indented code to code blocks."""
    written = []
    in_list = False
    for line in lines:
        line = re.sub(r'"(FILE:LINE[^"]*)"', r"``\1``", line)  # Otherwise it becomes a link.
        match = FIELD.fullmatch(line)
        if match:
            if not in_list:
                written.append("")
            in_list = True
            names = ", ".join(f"**{name}**" for name in match[1].split(", "))
            written.append(f"- {names}: {match[2]}")
        elif in_list and line.strip():
            written.append(f"  {line.strip()}")
        elif line.startswith("    ") and written and not written[-1].strip():
            written += ["::", "", line]
        else:
            in_list = False
            written.append(line)
    lines[:] = written


def setup(app):
    def inline(writer, node):
        writer.body.append(f'<span class="formula">{writer.encode(node.astext())}</span>')
        raise nodes.SkipNode

    def block(writer, node):
        writer.body.append(f'<div class="formula">{writer.encode(node.astext())}</div>')
        raise nodes.SkipNode

    app.add_html_math_renderer("katex", (inline, None), (block, None))
    app.connect("autodoc-process-docstring", docstring)
    app.add_transform(BlockLanguages)
    app.add_transform(WideTables)


html_math_renderer = "katex"
