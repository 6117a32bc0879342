#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What the first ten minutes and the tutorials say that a command prints is what it prints."""

import re
import shlex

from common import case, check, check_equal, main, run

COMMAND = re.compile(r"(?:build/release/bin/)?tagfield (run|localize|plan|explain|coverage|check) .*")
# Differ from run to run or between machines.
VARIABLE = re.compile(r"\(\d+ times real time\)")


def blocks(page):
    """Kind ("command", "text", "python") and text of each block of a page, by their order."""
    found = []
    for match in re.finditer(r"^```(\w+)\n(.*?)^```$|(?:^    \S[^\n]*\n(?:^ {6,}\S[^\n]*\n)*)+", page, re.MULTILINE | re.DOTALL):
        if match[1]:
            found.append((match[1], match[2]))
            continue
        joined = re.sub(r"\\\n\s*", "", match[0])
        found += [("command", line.strip()) for line in joined.splitlines()]
    return found


def plain(text):
    """Lines without what varies, and with blanks as one."""
    return [re.sub(r"\s+", " ", VARIABLE.sub("", line)).strip() for line in text.splitlines()]


def missing_lines(expected, printed):
    """Those that were not printed in this order; … stands for any lines."""
    rest = iter(plain(printed))
    return [line for line in plain(expected) if line not in ("", "…") and not any(line == other for other in rest)]


def run_page(context, name, leave_out="$."):
    """Runs a page's commands in a folder with the shipped files, and compares what they print. Leaves out the commands
    that match, and returns how many texts were compared."""
    page = (context.source / "docs" / name).read_text(encoding="utf-8")
    for shipped in ("scenarios", "examples", "worlds", "models", "profiles"):
        (context.folder / shipped).symlink_to(context.source / shipped)
    printed = []  # By the commands just before a text.
    previous = None
    compared = 0
    for kind, text in blocks(page):
        if kind != "text" and kind != previous:
            printed = []
        previous = kind
        if kind == "command" and COMMAND.fullmatch(text) and not re.search(leave_out, text):
            words = shlex.split(re.sub(r"\s+#.*", "", text).replace("build/release/bin/", ""))
            result = run([context.tagfield, *words[1:]], cwd=context.folder)
            check(result.code == 0, f"{name}: {text}: exit code {result.code}, {result.err.strip()[-300:]!r}")
            printed.append(result.out)
        elif kind == "text" and printed:
            lacking = min((missing_lines(text, out) for out in printed), key=len)
            check(not lacking, f"{name}: not printed: {lacking[:3]}")
            compared += 1
    return compared


@case
def first_ten_minutes(context):
    check_equal(run_page(context, "first_ten_minutes.md"), 5, "texts compared")


@case
def robot(context):
    # Mapping takes long: its test is that of the scenarios, and of the run with a kidnapped robot.
    check_equal(run_page(context, "tutorial_robot.md", r"slam\.yaml$|laser\.sigma_m|start=random|--ros2"), 4, "texts compared")


@case
def integrator(context):
    check_equal(run_page(context, "tutorial_integrator.md"), 8, "texts compared")


if __name__ == "__main__":
    main()
