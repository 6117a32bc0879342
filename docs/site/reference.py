# SPDX-License-Identifier: Apache-2.0
"""Reference pages, generated from the program's help and the sources."""

import functools
import pathlib
import re
import subprocess

import keys

KINDS = {"TEXT": "text", "UINT": "whole number", "INT": "whole number", "FLOAT": "number", "POSITIVE": "> 0",
         "NONNEGATIVE": "≥ 0", "DIR": "folder"}
ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(\S.*))?$")


@functools.lru_cache(maxsize=None)
def help_of(tagfield, *command):
    return subprocess.run([tagfield, *command, "--help"], check=True, stdout=subprocess.PIPE,
                          encoding="utf-8").stdout


def commands_of(text):
    """Names and descriptions of the subcommands in a help text."""
    listed = text.split("Subcommands:\n", 1)[1].split("\n\n", 1)[0]
    return dict(re.findall(r"^  (\S+)\s+(.*)$", listed, re.MULTILINE))


def entries(section):
    """Names and descriptions in a section of a help text: options or arguments."""
    found = []
    for line in section.split("\n"):
        match = ENTRY.match(line)
        if match:
            found.append([match[1], match[2] or ""])
        elif found and line.strip():
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
    return found


def kind_of(words):
    """The type of an option's value, in words."""
    words = re.sub(r"(UINT|INT|FLOAT):\1 in \[(\S+) - (\S+)\]",
                   lambda match: f"{KINDS[match[1]]}, {match[2]} to {match[3]}", words)
    words = re.sub(r"TEXT:\{([^}]*)\}", lambda match: match[1].replace(",", ", "), words)
    words = re.sub(r"FLOAT:(POSITIVE|NONNEGATIVE)", lambda match: f"number {KINDS[match[1]]}", words)
    words = re.sub(r"\b(TEXT|UINT|INT|FLOAT|DIR)\b", lambda match: KINDS[match[1]], words)
    return words.replace(" REQUIRED", ", required").replace(" ...", ", several").strip()


def cell(text):
    """A table cell; characters with a meaning in Markdown are escaped."""
    text = re.sub(r"(--[a-z][a-z0-9-]*)", r"`\1`", text)
    return text.replace("|", "\\|").replace("*", "\\*").replace("<", "\\<").replace("$", "\\$") or " "


def table(rows, head):
    lines = [f"| {' | '.join(head)} |", "|" + "---|" * len(head)]
    lines += [f"| {' | '.join(row)} |" for row in rows]
    return "\n".join(lines) + "\n"


def option_row(name, description):
    """A table row for an option such as `--seeds UINT:UINT in [1 - 9] Excludes: --drive`."""
    match = re.match(r"((?:-\w,)?--?[\w-]+|[A-Z]+)\s*(.*)", name)
    words, *limits = re.split(r"\b(?=Needs:|Excludes:)", match[2])
    notes = " ".join(limit.replace("Needs:", "Only with").replace("Excludes:", "Not with").strip() + "."
                     for limit in limits)
    description = description + ("" if description.endswith(".") or not notes else ".")
    return [f"`{match[1]}`", cell(kind_of(words)), cell(f"{description} {notes}".strip())]


def command_page(tagfield, name, does):
    text = help_of(tagfield, name)
    parts = re.split(r"^(Positionals|Options):\n", text, flags=re.MULTILINE)
    usage = re.search(r"^Usage: (.*)$", text, re.MULTILINE)[1]
    written = [f"## {name}\n", does + ".\n", f"```text\n{usage}\n```\n"]
    footer = ""
    for title, section in zip(parts[1::2], parts[2::2]):
        section, _, footer = section.partition("\n\n")
        rows = [option_row(*entry) for entry in entries(section) if entry[0] != "-h,--help"]
        if rows:
            written.append(table(rows, ["argument" if title == "Positionals" else "option", "takes", ""]))
    footer = footer.strip("\n")
    if footer and not footer.startswith("'tagfield COMMAND"):
        written.append(f"```text\n{footer}\n```\n")
    return "\n".join(written)


def commands_page(tagfield):
    listed = commands_of(help_of(tagfield))
    head = ("# Commands\n\nMade from `tagfield COMMAND --help` by the build of this site. Exit code 2 means that an "
            "input is wrong.\n\n")
    rows = [[f"[`{name}`](#{name})", cell(does)] for name, does in listed.items()]
    return head + table(rows, ["command", ""]) + "\n" + "\n".join(
        command_page(tagfield, name, does) for name, does in listed.items())


def keys_page(top):
    written = ["# All keys of YAML files\n",
               "Every key that the sources read from a scenario, suite, profile or specification, and the page that "
               "describes it.\n"]
    rows = []
    for name, entry in sorted(keys.keys(top).items()):
        pages = keys.pages_of(top, entry, name)
        rows.append([f"`{name}`", ", ".join(f"[{page}]({page}.md)" for page in pages)])
    return "\n".join(written) + "\n" + table(rows, ["key", "described in"])


def messages_page(top):
    written = ["# Messages\n",
               "Of ROS 1 and ROS 2 alike, the package `tagfield_msgs`; topics are in [gazebo.md](gazebo.md#topics) and "
               "[ros2.md](ros2.md#topics). Gazebo's own transport has the second set "
               "([gz.md](gz.md#topics-of-gazebos-transport)).\n"]
    for title, pattern in (("ROS", "adapters/tagfield_msgs/msg/*.msg"),
                           ("Gazebo's transport", "adapters/gz/msgs/tagfield/msgs/*.proto")):
        written.append(f"## {title}\n")
        for path in sorted(top.glob(pattern)):
            language = "protobuf" if path.suffix == ".proto" else "text"
            written.append(f"### {path.stem if path.suffix == '.msg' else path.name}\n\n"
                           f"```{language}\n{path.read_text(encoding='utf-8').rstrip()}\n```\n")
    return "\n".join(written)


def api_sections(top):
    """Yields (title, headers) for each component of docs/api.md that has headers."""
    text = (top / "docs/api.md").read_text(encoding="utf-8")
    for section in re.split(r"^## ", text, flags=re.MULTILINE)[1:]:
        title, _, body = section.partition("\n")
        headers = re.findall(r"^\| `(tagfield/\S+\.h)` \| (.*) \|$", body, re.MULTILINE)
        if headers:
            yield title.strip(), headers


def cpp_pages(top):
    """Yields (name, text) of a page for each component, and of one that lists them."""
    names = []
    for title, headers in api_sections(top):
        name = f"cpp_{title}"
        names.append(name)
        written = [f"# C++: {title}\n"]
        for header, does in headers:
            written.append(f"## {header}\n\n{does[0].upper()}{does[1:]}.\n\n```{{doxygenfile}} {header}\n"
                           "```\n")
        yield name, "\n".join(written)
    listed = "\n".join(f"- [{name.removeprefix('cpp_')}]({name}.md)" for name in names)
    yield "cpp_api", ("# C++ API\n\nMade from the docstrings of the installed headers; all is in namespace `tagfield`. [Headers](api.md) says what each "
                      f"is for and how to link them.\n\n{listed}\n\n```{{toctree}}\n:hidden:\n\n"
                      + "\n".join(names) + "\n```\n")


def python_page():
    import tagfield

    written = ["# Python API\n", "Made from the package's docstrings; [Python](python.md) begins from nothing.\n"]
    groups = {"Functions": [], "Classes": []}
    for name in tagfield.__all__:
        thing = getattr(tagfield, name)
        if name == "plot":
            continue
        if isinstance(thing, type):
            groups["Classes"].append(f"```{{eval-rst}}\n.. autoclass:: tagfield.{name}\n   :members:\n```\n")
        else:
            groups["Functions"].append(f"```{{eval-rst}}\n.. autofunction:: tagfield.{name}\n```\n")
    for title, items in groups.items():
        written += [f"## {title}\n", *items]
    written += ["## Plots\n", "```{eval-rst}\n.. automodule:: tagfield.plot\n   :members:\n```\n"]
    return "\n".join(written)


def write_pages(top, tagfield, folder):
    pages = {"commands": commands_page(tagfield), "all_keys": keys_page(top), "messages": messages_page(top),
             **dict(cpp_pages(top)), "python_api": python_page()}
    for name, text in pages.items():
        (pathlib.Path(folder) / f"{name}.md").write_text(text, encoding="utf-8")
