# SPDX-License-Identifier: Apache-2.0
"""Atomic results: files of others in the folder are kept, and however the program ends, the folder
contains either the old result or the new one.

Faults are injected by a preloaded library (faults.c): a kill at the Nth rename, a disk that is full from
the Nth write on, a signal at the first fsync, a failure of the Nth allocation. scripts/faults tries many
more.
"""

import os
import pathlib
import subprocess

from common import case, check, check_equal, check_in, files_in, main
from faulty import counts_in, environment_with, fault_library, is_left_over, result_in

OTHERS = {"figures/mine.svg": "<svg/>", "map.pgm": "mine", "truth/notes.csv": "a,b\n"}


def run_with(context, library, arguments, fault=None, count_file=None):
    """Exit code (negative for a signal) and standard error of a run with a fault."""
    done = subprocess.run([str(word) for word in [context.tagfield, *arguments]],
                          cwd=context.folder, env=environment_with(library, fault, count_file),
                          capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=300,
                          check=False)
    return done.returncode, done.stderr


def counts(context, library, arguments):
    """Number of calls of each kind during such a run."""
    path = context.folder / "counts"
    code, said = run_with(context, library, arguments, count_file=path)
    check_equal(code, 0, f"exit code with the counting library ({said})")
    return counts_in(path)


def kept(folder):
    """The files without leftovers of an aborted run."""
    return {name: content for name, content in files_in(folder).items() if not is_left_over(name)}


def commands(context):
    """Arguments of each command that writes a folder, without --out."""
    run = context.simulate("two_antennas", "--no-page", name="input")
    suite = context.write("suite.yaml", f"scenario: {context.shipped('z_axis')}\nseeds: 2\n"
                                        "methods: [hyperbola]\nconditions: [{name: plain}]\n")
    reads = [run / "reads.csv", "--poses", run / "antenna_poses.csv"]
    header, *rows = reads[0].read_text(encoding="utf-8").splitlines(keepends=True)
    of_one_tag = context.write("of_one_tag.csv",
                               header + "".join(row for row in rows if ",tag10," in row))
    return {"run": ["run", context.shipped("two_antennas")],
            "localize": ["localize", *reads],
            "track": ["track", of_one_tag, *reads[1:], "--lane", 0, 0, 0],
            "bench": ["bench", suite],
            "coverage": ["coverage", context.shipped("two_antennas"), "--height", 1, "--step", 0.5]}


@case
def what_others_wrote_stays(context):
    for name, command in commands(context).items():
        for file, text in OTHERS.items():
            context.write(f"{name}/{file}", text)
        for _ in range(2):
            context.run_well(*command, "--out", name)
        for file, text in OTHERS.items():
            path = context.folder / name / file
            check(path.exists() and path.read_text(encoding="utf-8") == text,
                  f"{name}: {file} is not what it was")
        left = [path.name for path in (context.folder / name).iterdir()
                if path.name.startswith(("incomplete-", ".tagfield-"))]
        check_equal(left, [], f"what {name} leaves beside its results")


@case
def what_others_wrote_is_not_replaced(context):
    first = {"run": "reads.csv", "localize": "estimates.csv", "track": "tracks.csv",
             "bench": "bench.csv", "coverage": "coverage.json"}
    for name, command in commands(context).items():
        context.write(f"{name}/{first[name]}", "mine")
        result = context.run(*command, "--out", name)
        check_equal(result.code, 2, f"{name}: exit code")
        check_in(f"{first[name]}: was not written by Tagfield", result.err, f"{name}: complaint")
        left = files_in(context.folder / name)
        left.pop("resume.log", None)  # Finished runs of a bench, for --resume.
        check_equal(left, {first[name]: b"mine"}, f"{name}: files")


@case
def a_folder_that_is_a_link_is_not_followed(context):
    context.write("elsewhere/fig09_map.svg", "theirs")
    out = context.simulate("two_antennas", "--no-page")
    os.symlink("../elsewhere", out / "figures")
    before = kept(out)
    for arguments in (["report", out], ["run", context.shipped("two_antennas"), "--out", out]):
        result = context.run(*arguments)
        check_equal(result.code, 2, "exit code")
        check_in("figures: is a symbolic link", result.err, "complaint")
    check(kept(out) == before, "files changed")
    check_equal((context.folder / "elsewhere/fig09_map.svg").read_text(encoding="utf-8"), "theirs",
                "the file outside")


def old_and_new(context):
    """The content of a folder before and after the run into which faults are injected."""
    return (result_in(files_in(context.simulate("two_antennas", name="old"))),
            result_in(files_in(context.simulate("z_axis", name="new"))))


def kill_at_each_rename(context, library, others=()):
    """Counts how often the folder contains the old or the new result after the kill, as left behind,
    and again after `report` has opened it."""
    old, new = old_and_new(context)
    beside = {name: text.encode() for name, text in others}
    command = ["run", context.shipped("z_axis"), "--force", "--out", "out"]
    context.simulate("two_antennas", name="out")
    for name, text in others:
        context.write(f"out/{name}", text)
    steps = counts(context, library, command)["rename"]
    as_left = {"old": 0, "new": 0, "neither": 0}
    looked_at = dict(as_left)

    def outcome():
        found = result_in(files_in(context.folder / "out"))
        check(all(found.pop(name, None) == text for name, text in beside.items()), "others' files")
        return "old" if found == old else "new" if found == new else "neither"

    for step in range(1, steps + 1):
        context.simulate("two_antennas", name="out")
        code, _ = run_with(context, library, command, f"rename:{step}:KILL")
        check_equal(code, -9, f"exit code when killed at rename {step}")
        as_left[outcome()] += 1
        context.run_well("report", "out")
        looked_at[outcome()] += 1
    context.simulate("z_axis", name="out")
    check_equal([name for name in files_in(context.folder) if is_left_over(name)], [], "left over")
    return steps, as_left, looked_at


@case
def ended_as_soon_as_something_lies_in_the_folder(context):
    """SIGTERM while a command creates the staging folder for its results."""
    library = fault_library(context.folder)
    for name, command in commands(context).items():
        code, said = run_with(context, library, [*command, "--out", name], "sync:1:TERM")
        check_in(code, (-15, 0, 130), f"{name}: exit code ({said})")
        left = [file for file in files_in(context.folder / name) if is_left_over(file)]
        check_equal(left, [], f"what {name} leaves")


@case
def without_memory_from_the_start(context):
    """Allocation failures in constructors before main(), where exceptions cannot be caught."""
    library = fault_library(context.folder)
    for number in (10, 20, 33, 60, 102):
        code, said = run_with(context, library, ["check", context.shipped("z_axis")],
                              f"alloc:{number}+:ENOMEM")
        check_equal((code, said), (2, "tagfield: there is not enough memory for this\n"),
                    f"from allocation {number} on")


@case
def without_memory_while_a_folder_is_looked_through(context):
    """Allocation failures that terminate the program, as the exception leaves a noexcept function."""
    library = fault_library(context.folder)
    context.simulate("z_axis", "--no-page", name="input")
    command = ["localize", "input/reads.csv", "--poses", "input/antenna_poses.csv", "--method", "sar",
               "--out", "out"]
    (context.folder / "out").mkdir()
    # The first folder is created right after that.
    path = context.folder / "counts"
    code, said = run_with(context, library, command, "mkdir:1:ENOSPC", path)
    check_equal(code, 2, f"exit code where no folder can be made ({said})")
    after = counts_in(path)["alloc"]
    for number in range(after - 60, after):
        code, said = run_with(context, library, command, f"alloc:{number}:ENOMEM")
        check_in(code, (0, 2), f"exit code without memory at allocation {number} ({said})")
        if code == 2:
            check_equal(said, "tagfield: there is not enough memory for this\n", "complaint")


@case
def killed_at_each_step_of_a_commit(context):
    """In a folder without files of others, all files are replaced at once."""
    steps, as_left, looked_at = kill_at_each_rename(context, fault_library(context.folder))
    check_equal(as_left, {"old": steps, "new": 0, "neither": 0}, "what is there")
    check_equal(looked_at, as_left, "what is there after a look")


@case
def killed_at_each_step_of_a_commit_among_others_files(context):
    """Next to files of others, they are moved one by one; the next command that reads the folder
    completes that."""
    steps, _, looked_at = kill_at_each_rename(context, fault_library(context.folder),
                                              [("notes.txt", "mine"), ("truth/notes", "mine")])
    check(steps > 15, f"only {steps} renames")
    check_equal(looked_at["neither"], 0, "neither the old result nor the new")
    check(looked_at["old"] > 0 and looked_at["new"] > 10, f"outcomes {looked_at}")


@case
def a_disk_that_is_full_at_each_write(context):
    library = fault_library(context.folder)
    old = context.simulate("two_antennas", name="out")
    before = files_in(old)
    command = ["run", context.shipped("z_axis"), "--force", "--out", "out"]
    writes = counts(context, library, [*command[:4], "counted"])["write"]
    check(writes > 15, f"only {writes} writes")
    for step in range(1, writes + 1):
        code, said = run_with(context, library, command, f"write:{step}+:ENOSPC")
        check_equal(code, 2, f"exit code when the disk is full at write {step} ({said})")
        check_in("No space left on device", said, "complaint")
        found = kept(old)
        check_equal(sorted(found), sorted(before), f"files with a disk full at write {step}")
        check(found == before, f"a disk full at write {step} changed the old result")


@case
def a_system_that_gives_no_threads(context):
    """If no threads can be created, the main thread does all work, with the same result."""
    library = fault_library(context.folder)
    result = result_in(files_in(context.simulate("z_axis", name="many")))
    code, said = run_with(context, library, ["run", context.shipped("z_axis"), "--force", "--out", "one"],
                          "thread:1+:EAGAIN")
    check_equal(code, 0, f"exit code without threads ({said})")
    check(result_in(files_in(context.folder / "one")) == result, "the result is another")


@case
def devices_are_written_to_and_not_replaced(context):
    world = context.run("gazebo", context.shipped("two_antennas"), "--out", "/dev/stdout")
    check_equal(world.code, 0, "exit code")
    check_in("<sdf", world.out, "what is printed")
    result = context.run("gazebo", context.shipped("two_antennas"), "--out", "/dev/full")
    check_equal(result.code, 2, "exit code with a full device")
    check(pathlib.Path("/dev/full").is_char_device(), "/dev/full is no device any more")


if __name__ == "__main__":
    main()
