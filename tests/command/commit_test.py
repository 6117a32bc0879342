"""Results in a folder: what others wrote there stays, and whatever ends the program, the folder holds
the old result or the new one.

Faults are made by a library loaded before the C library (faults.c): a kill at the Nth rename, a disk
that is full from the Nth write on.
"""

import os
import pathlib
import subprocess

from common import (Skip, case, check, check_equal, check_in, clean_environment, files_in, main)

TIMED = ("summary.json", "report.html")  # They hold how long it took.
OTHERS = {"figures/mine.svg": "<svg/>", "map.pgm": "mine", "truth/notes.csv": "a,b\n"}


def faults(context):
    """Builds the library of faults.c; gives its path."""
    library = context.folder / "faults.so"
    source = pathlib.Path(__file__).parent / "faults.c"
    built = subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-Wall", "-Werror", "-o", library,
                            source, "-ldl"], capture_output=True, text=True, check=False)
    if built.returncode != 0:
        raise Skip(f"cc does not build faults.c: {built.stderr.strip()[:200]}")
    return library


def run_with(context, library, arguments, **settings):
    """The exit code (negative: the signal) and the standard error of a run with a fault."""
    environment = clean_environment() | {"LD_PRELOAD": str(library)}
    environment |= {name: str(value) for name, value in settings.items()}
    done = subprocess.run([str(word) for word in [context.tagfield, *arguments]],
                          cwd=context.folder, env=environment, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, timeout=300, check=False)
    return done.returncode, done.stderr


def counts(context, library, arguments):
    """How many renames and writes such a run makes."""
    path = context.folder / "counts"
    code, said = run_with(context, library, arguments, COUNT_FILE=path)
    check_equal(code, 0, f"exit code with the counting library ({said})")
    return [int(word) for word in path.read_text(encoding="ascii").split()]


def kept(folder):
    """The files but those of a run that was cut off, which stand apart."""
    return {name: content for name, content in files_in(folder).items()
            if not name.startswith("incomplete-")}


def result_in(folder):
    """What does not depend on how long it took, and which files there are."""
    return {name: None if name in TIMED else content for name, content in kept(folder).items()}


def commands(context):
    """Each command that fills a folder, with all but --out."""
    run = context.simulate("two_antennas", "--no-page", name="input")
    suite = context.write("suite.yaml", f"scenario: {context.shipped('z_axis')}\nseeds: 2\n"
                                        "methods: [hyperbola]\nconditions: [{name: plain}]\n")
    reads = [run / "reads.csv", "--poses", run / "antenna_poses.csv"]
    return {"run": ["run", context.shipped("two_antennas")],
            "localize": ["localize", *reads],
            "track": ["track", *reads, "--lane", 0, 0, 0],
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
        check_equal(files_in(context.folder / name), {first[name]: b"mine"}, f"{name}: files")


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


@case
def killed_at_each_step_of_a_commit(context):
    library = faults(context)
    old = result_in(context.simulate("two_antennas", name="old"))
    command = ["run", context.shipped("z_axis"), "--out", "out"]
    context.simulate("two_antennas", name="out")
    steps = counts(context, library, command)[0]
    new = result_in(context.folder / "out")
    check(steps > 15, f"only {steps} renames")
    outcomes = {"old": 0, "new": 0}
    for step in range(1, steps + 1):
        context.simulate("two_antennas", name="out")
        code, _ = run_with(context, library, command, KILL_AT_RENAME=step)
        check_equal(code, -9, f"exit code when killed at rename {step}")
        context.run_well("report", "out")
        found = result_in(context.folder / "out")
        if check(found in (old, new), f"killed at rename {step}: neither the old result nor the new"):
            outcomes["old" if found == old else "new"] += 1
    check(outcomes["old"] > 0 and outcomes["new"] > 10, f"outcomes {outcomes}")


@case
def a_disk_that_is_full_at_each_write(context):
    library = faults(context)
    old = context.simulate("two_antennas", name="out")
    before = files_in(old)
    command = ["run", context.shipped("z_axis"), "--out", "out"]
    writes = counts(context, library, [*command[:3], "counted"])[1]
    check(writes > 15, f"only {writes} writes")
    for step in range(1, writes + 1):
        code, said = run_with(context, library, command, FULL_AT_WRITE=step)
        check_equal(code, 2, f"exit code when the disk is full at write {step} ({said})")
        check_in("No space left on device", said, "complaint")
        found = kept(old)
        check_equal(sorted(found), sorted(before), f"files with a disk full at write {step}")
        check(found == before, f"a disk full at write {step} changed the old result")


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
