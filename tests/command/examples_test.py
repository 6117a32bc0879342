#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The examples work as documented, from the build tree and with the installed package."""

import math
import re
import shlex
import shutil

from common import (Skip, case, check, check_between, check_equal, check_in, check_near, main,
                    position, read_csv, read_json, run)

def documented_commands(path):
    """The tagfield commands that are indented in a text or in a file's comments."""
    text = re.sub(r"\\\n\s*#?\s*", " ", path.read_text(encoding="utf-8"))
    found = re.findall(r"^#?\s+build/release/bin/tagfield (.*)$", text, re.MULTILINE)
    return [shlex.split(line, comments=True) for line in found]


def run_documented(context, arguments, out):
    """Runs a command from the source tree, as documented, but with results in the test's folder."""
    words = [word for i, word in enumerate(arguments)
             if word != "--out" and (i == 0 or arguments[i - 1] != "--out")]
    if words[0] in ("run", "localize"):
        words += ["--out", out]
    result = run([context.tagfield, *words], cwd=context.source)
    check_equal(result.code, 0, f"exit code of {words}")
    for line in result.err.splitlines():
        check(line.startswith("tagfield: warning: "), f"{words} says {line!r}")
    return result


@case
def one_link(context):
    program = context.build / "bin/example_one_link"
    if not program.exists():
        raise Skip(f"{program} is not built")
    result = run([program])
    check_equal(result.code, 0, "exit code")
    check_in("tag1 at 3.00 m: phase ", result.out, "example_one_link")
    phase, rssi = map(float, re.search(r"phase ([\d.]+) rad, RSSI (-?\d+) dBm", result.out).groups())
    wavelength = 299792458.0 / 865.7e6
    check_between(math.remainder(phase - 4 * math.pi * 3.0 / wavelength, 2 * math.pi), -0.5, 0.5,
                  "phase less 4πD/λ")
    amplitude = 3.0 * wavelength / (4 * math.pi * 3.0)
    # Noise of 0.01 on an amplitude of 0.0275: a bound of five standard deviations.
    check_between(rssi, -120.0, 40 * math.log10(amplitude + 0.05), "RSSI")


@case
def own_world(context):
    example = context.source / "examples/02_own_world"
    commands = documented_commands(example / "workshop.yaml")
    check_equal([command[0] for command in commands], ["check", "run"], "commands of the example")
    out = context.folder / "out"
    outputs = [run_documented(context, command, out).out for command in commands]
    for word in ("drill", "gate_antenna", "pallet", "cupboard"):
        check_in(word, outputs[0], "check")
    tags = {tag["id"]: tag for tag in read_json(out / "summary.json")["tags"]}
    check_equal(set(tags), {"drill", "toolbox"}, "tags")
    check_equal(tags["drill"]["truth_m"], [0.3, 2.74, 1.3], "place of the drill")
    for name, tag in tags.items():
        check_equal(tag["verdict"], "located", f"verdict of {name}")
        check_between(tag["error_m"], 0.0, 0.05, f"error of {name}")
    check_equal({row["antenna"] for row in read_csv(out / "reads.csv")},
                {"gate_antenna", "cart_antenna"}, "antennas")


@case
def own_csv(context):
    readme = context.source / "examples/03_own_csv/README.md"
    text = readme.read_text(encoding="utf-8").replace("−", "-")
    places = [tuple(map(float, pair)) for pair in
              re.findall(r"\((-?\d+\.\d+), (-?\d+\.\d+)\)", text)]
    check_equal(len(places), 2, "places of tags in the README")
    commands = documented_commands(readme)
    check_equal(len(commands), 1, "commands in the README")
    out = context.folder / "out"
    run_documented(context, commands[0], out)
    found = [position(row) for row in read_csv(out / "estimates.csv")
             if row["verdict"] == "located"]
    check_equal(len(found), 2, "tags located")
    for place in places:
        nearest = min(found, key=lambda p, place=place: math.dist(p[:2], place))
        check_near(math.dist(nearest[:2], place), 0.0, 0.03, f"distance of an estimate to {place}")
        check_near(nearest[2], 0.8, 1e-6, "height")


# --- The installed package ------------------------------------------------------------------------

def install(context):
    if not list(context.build.rglob("libtagfield_experiment.a")):
        raise Skip("not all libraries are built")
    prefix = context.folder / "installed"
    result = run(["cmake", "--install", context.build, "--prefix", prefix])
    check_equal(result.code, 0, f"exit code of cmake --install ({result.err[-400:]!r})")
    return prefix


def configure(source, build, prefix, *options):
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    return run(["cmake", *generator, "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}",
                "-DCMAKE_BUILD_TYPE=Release", *options], timeout=600)


def build_and_run(context, prefix, source, *arguments, options=()):
    """Builds a program with the installed package and returns its output, or "" if that fails."""
    program = re.sub(r"^\d+_", "", source.name)
    build = context.folder / program
    for name, step in (("configure", lambda: configure(source, build, prefix, *options)),
                       ("build", lambda: run(["cmake", "--build", build], timeout=600))):
        result = step()
        if not check(result.code == 0, f"{name} {program}: {(result.out + result.err)[-1500:]}"):
            return ""
    result = run([build / program, *arguments], cwd=context.folder)
    check_equal((result.code, result.err), (0, ""), f"exit code and stderr of {program}")
    return result.out


def build_example(context, prefix, name, *arguments):
    return build_and_run(context, prefix, context.source / "examples" / name, *arguments)


def check_own_program(context, prefix):
    out = build_example(context, prefix, "04_own_program")
    found = {name: (float(x), float(y)) for name, x, y in
             re.findall(r"^(\w+): (-?[\d.]+) (-?[\d.]+) m$", out, re.MULTILINE)}
    # Positions in own_program.cc.
    for name, place in {"first": (2.0, 2.5), "second": (1.0, -2.0)}.items():
        check(name in found and math.dist(found[name], place) < 0.05,
              f"{name} is at {found.get(name)}, expected {place}: {out!r}")


def check_own_method(context, prefix):
    out = build_example(context, prefix, "05_own_method", context.shipped("paper_warehouse"))
    rows = re.findall(r"^  (\w+) +(\d+)/30 +\d+ +\d+ +\d+ +([\d.]+)", out, re.MULTILINE)
    check_equal([row[0] for row in rows], 2 * ["hyperbola", "centroid", "sharper"],
                f"methods in {out!r}")
    mean_mm = [float(row[2]) for row in rows]
    check_equal([row[1] for row in rows[:2]], ["30", "30"], "tags located with the true pose")
    check_between(mean_mm[0], 0.0, 10.0, "mean error of the hyperbolae [mm]")
    # The path is 3 to 6 m from the racks.
    check_between(mean_mm[1], 1000.0, 7000.0, "mean error of the centroid [mm]")
    check(mean_mm[2] != mean_mm[1], f"its setting changes nothing: {out!r}")


def expected_rates(reads, distances, interval_s=5.0):
    """Reads per second of each antenna and the maximum distance so far, every interval_s, from tables."""
    rows, counts, farthest, end = [], {}, 0.0, interval_s
    for read, distance in zip(reads, distances):
        farthest = max(farthest, float(distance["distance_m"]))
        if float(read["stamp_s"]) >= end:
            rows.append((end, {name: n / interval_s for name, n in counts.items()}, farthest))
            counts = dict.fromkeys(counts, 0)
            while end <= float(read["stamp_s"]):
                end += interval_s
        counts[read["antenna"]] = counts.get(read["antenna"], 0) + 1
    return rows


def check_own_outlet(context, prefix):
    out = build_example(context, prefix, "06_own_outlet", context.shipped("two_antennas"))
    folder = context.simulate("two_antennas", "--no-page")
    expected = expected_rates(read_csv(folder / "reads.csv"), read_csv(folder / "truth/distances.csv"))
    lines = out.splitlines()
    check(len(lines) > 3, f"own_outlet prints {out!r}")
    check_equal(len(lines), len(expected), "lines of own_outlet")
    for line, (end, rates, farthest) in zip(lines, expected):
        check(line.startswith(f"{end:5.1f} s:"), f"{line!r} is of {end} s")
        check_near(float(re.search(r"up to ([\d.]+) m", line).group(1)), farthest, 0.006, line)
        printed = {name: float(rate) for name, rate in re.findall(r" (\w+) (\d+) reads/s", line)}
        check_equal(set(printed), set(rates), f"antennas in {line!r}")
        for name, rate in rates.items():
            check_near(printed[name], rate, 0.51, f"rate of {name} in {line!r}")


def check_installed_command(context, prefix):
    scenario = prefix / "share/tagfield/scenarios/paper_warehouse.yaml"
    result = run([prefix / "bin/tagfield", "run", scenario, "--out", "out"], cwd=context.folder)
    check_equal((result.code, result.err), (0, ""), "exit code and stderr of the installed command")
    check_equal(read_json(context.folder / "out/summary.json")["located"], 10, "located")


@case
def the_installed_package(context):
    """The installed command, scenario and world, and programs that use the libraries."""
    prefix = install(context)
    check_installed_command(context, prefix)
    check_own_program(context, prefix)
    check_own_method(context, prefix)
    check_own_outlet(context, prefix)
    for path in prefix.rglob("*"):
        name = str(path.relative_to(prefix))
        check("/test/" not in name and "/internal/" not in name, f"{name} is installed")
        if path.suffix == ".cmake":
            text = path.read_text(encoding="utf-8")
            check(str(context.source) not in text and str(context.build) not in text,
                  f"{name} names the source or the build tree")


OTHER_PACKAGES = ("Boost", "CLI11", "PNG", "PkgConfig", "assimp", "embree", "nlohmann_json",
                  "yaml-cpp")


@case
def a_component_needs_its_own_packages_alone(context):
    """Localization if CMake finds only Eigen and fmt, without the packages of other components."""
    prefix = install(context)
    source = context.source / "tests/command/localization_alone"
    options = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=TRUE" for name in OTHER_PACKAGES]
    out = build_and_run(context, prefix, source, options=options)
    places = re.findall(r"^tag: ([-\d.]+) ([-\d.]+) m$", out, re.MULTILINE)
    check(places and math.dist(map(float, places[0]), (1.5, 2.0)) < 0.01,
          f"the tag at (1.5, 2) is located at {out!r}")
    linked = run(["ldd", context.folder / "localization_alone/localization_alone"]).out
    libraries = {re.match(r"\s*(?:/\S*/)?(ld-linux|lib[a-z]+|linux-vdso)", line).group(1)
                 for line in linked.splitlines()}
    check_equal(libraries - {"ld-linux", "linux-vdso", "libc", "libm", "libgcc", "libstdc"}, {"libfmt"},
                "libraries that the program loads")
    result = configure(source, context.folder / "kitchen", prefix, "-DCOMPONENTS=localization;kitchen")
    check(result.code != 0, "a component that there is not is found")
    check_in("there is no component 'kitchen'", " ".join(result.err.split()), "what CMake says of it")


@case
def installed_headers_are_those_that_are_listed(context):
    """tests/structure/headers_alone_test.py checks that each compiles alone."""
    include = install(context) / "include"
    headers = sorted(str(path.relative_to(include)) for path in include.rglob("*.h"))
    listed = re.findall(r"^\| `(tagfield/\S+\.h)`", (context.source / "docs/api.md").read_text(
        encoding="utf-8"), re.MULTILINE)
    check_equal(headers, sorted(listed), "the headers that are installed, and those in docs/api.md")


@case
def planning_environment(context):
    package = context.build / "lib/python"
    if not any(package.glob("tagfield/_core*.so")):
        raise Skip("the Python package is not built")
    example = context.source / "examples/10_planning_environment/read_aware_env.py"
    result = run(["env", f"PYTHONPATH={package}", "/usr/bin/python3", "-B", example])
    check_equal(result.code, 0, f"exit code: {result.err[-300:]}")
    counts = dict(re.findall(r"^(\w+): (\d+) of 10 tags", result.out, re.MULTILINE))
    check_equal(counts.get("greedy"), "10", f"tags that the greedy policy reads: {result.out!r}")
    check_between(int(counts.get("random", -1)), 0, 9, "tags that the random one reads")


if __name__ == "__main__":
    main()
