#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Invalid input gives a one-line error and exit code 2, and leaves no files; suspicious input a warning.

Each fault is one line of a table: the change to a valid input, and the expected error message. With
--show, the messages are printed for review.
"""

import json
import os
import shutil
import subprocess

from common import (Skip, case, check, check_equal, check_in, files_in, main, read_csv, read_json)

MOST_SECONDS = 10.0

SCENARIO = """\
name: base
description: A cart reads two tags
seed: 1
model: paper
time_step_s: 0.01
duration_s: 1
real_time: 0
robots:
  - name: cart
    start: [0, 0, 0]
    wheel_radius_m: 0.1
    track_m: 0.4
    speed_m_s: 0.5
    max_turn_rad_s: 1.0
    look_ahead_m: 0.3
    waypoints: [[1, 0], [1, 1]]
antennas:
  - name: mast
    reader: reader_1
    on: cart
    pose: [0, 0, 1]
    lift: {travel_m: 0.5, speed_m_s: 0.1}
    rate_hz: 15
    frequency_hz: 865.7e6
    phase_offset_rad: 0
    phase_noise_rad: 0.1
    rssi_noise: 0.01
    range_m: 7
    range_sigma: 0.05
    communication_gain: 3
    optional_distribution: normal_distribution
    optional_distribution_params: [0, 0.1]
  - name: gate
    pose: [2, 2, 1]
tags:
  - id: near
    position: [1, 2, 1]
    appears_s: 0
  - id: far
    trajectory: [[0, 2, 0, 1], [1, 3, 0, 1]]
    disappears_s: 0.9
pose:
  source: noisy
  sigma_m: 0.01
  yaw_sigma_deg: 0.5
  time_constant_s: 5
  wheel_noise: 0.01
localization:
  method: hyperbola
  stride_m: 0.3
  refine: true
  max_expected_error_m: 0.15
  max_rms_m: 0.08
  tag_height_m: 1
"""

MODEL = """\
<?xml version="1.0"?>
<sdf version="1.6">
  <world name="hall">
    <model name="rack">
      <static>true</static>
      <link name="link">
        <collision name="body"><geometry>GEOMETRY</geometry></collision>
      </link>
    </model>
  </world>
</sdf>
"""
BOX = "<box><size>1 1 1</size></box>"
WORLD = MODEL.replace("GEOMETRY", BOX)

ANTENNA_SENSOR = """\
        <sensor name="door" type="rfid">
          <update_rate>15</update_rate>
          <plugin name="door" filename="libgazeboRfidAntennaPlugin.so">
            <frequency>865.7e6</frequency>
            <noisephi>0.1</noisephi>
            <noiserssi>0.008</noiserssi>
            <range>7</range>
            <communication_gain>1</communication_gain>
            <optional_distribution>none</optional_distribution>
          </plugin>
        </sensor>
        <sensor name="parcel" type="rfidtag">
          <pose>1 1 1 0 0 0</pose>
          <plugin name="parcel" filename="libgazeboRfidTagPlugin.so"><epc>parcel</epc></plugin>
        </sensor>
"""
WORLD_WITH_SENSORS = WORLD.replace("      </link>", ANTENNA_SENSOR + "      </link>")

# A hall of 8 m by 5 m around the origin, with an enclosure of 2 m by 2 m without a door in its corner.
HALL_BOXES = ((0, 2.6, 8.4, 0.2), (0, -2.6, 8.4, 0.2), (4.1, 0, 0.2, 5.4), (-4.1, 0, 0.2, 5.4),
              (1.9, 1.5, 0.2, 2.0), (2.9, 0.4, 2.2, 0.2))
HALL = """\
<?xml version="1.0"?>
<sdf version="1.6">
  <world name="hall">
    <model name="walls">
      <static>true</static>
      <link name="link">
""" + "".join(f"""\
        <collision name="box_{i}"><pose>{x} {y} 1 0 0 0</pose>
          <geometry><box><size>{length} {width} 2</size></box></geometry></collision>
""" for i, (x, y, length, width) in enumerate(HALL_BOXES)) + """\
      </link>
    </model>
  </world>
</sdf>
"""
NAVIGATION = """\
name: driven
time_step_s: 0.02
world: {path: hall.sdf}
robots:
  - name: cart
    start: [0, 0, 0]
    goals: [[0.4, 0, 0]]
    kidnapped: [[300, -1, 0, 0]]
antennas:
  - {name: gate, pose: [2, 1, 1], rate_hz: 1}
tags:
  - {id: near, position: [1, 1, 1]}
navigation:
  mode: slam
  map: hall.yaml
  laser: {beams: 91}
obstacles:
  - {radius_m: 0.2, position: [-2, -1]}
"""
HALL_YAML = """\
image: hall.pgm
resolution: 0.1
origin: [-4.2, -2.7, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""


def hall_pgm(grey=None):
    """The hall's map as PGM, or an image of a single grey value."""
    columns, rows = 84, 54
    def grey_at(column, row):
        x, y = -4.2 + 0.1 * (column + 0.5), 2.7 - 0.1 * (row + 0.5)
        is_wall = any(abs(x - box[0]) < box[2] / 2 and abs(y - box[1]) < box[3] / 2
                      for box in HALL_BOXES)
        return 0 if is_wall else 254
    cells = bytes(grey if grey is not None else grey_at(column, row)
                  for row in range(rows) for column in range(columns))
    return f"P5\n{columns} {rows}\n255\n".encode() + cells


READS = """\
stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm
0.0,r,a,one,865700000,1.0,-50
0.1,r,a,one,865700000,1.1,-50
0.2,r,a,one,865700000,1.2,-50
"""
POSES = """\
stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw
0.0,a,0.0,0,1,0,0,0,1
0.1,a,0.1,0,1,0,0,0,1
0.2,a,0.2,0,1,0,0,0,1
"""
HEIGHTS = "tag,height_m\none,1.0\n"

TETRAHEDRON_STL = """\
solid s
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
facet normal 0 1 0
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 0 1
endloop
endfacet
endsolid s
"""


# --- Expected error messages ----------------------------------------------------------------------

def stranger(context):
    """An output folder with files of an earlier run and an unrelated file."""
    out = context.folder / "out"
    if not out.exists():
        context.write("out/report.html", "old page")
        context.write("out/reads.csv", "old reads")
        context.write("out/truth/tags.csv", "old truth")
        context.write("out/notes.txt", "somebody's notes")
        context.write("out/.tagfield", "report.html\nreads.csv\ntruth/tags.csv\n")
    return out


def expect_complaint(context, name, arguments, says, line=None, file=None):
    """Runs the program and checks its error message, and that it changes no files."""
    before = files_in(context.folder)
    result = context.run(*arguments, timeout=60)
    if context.show:
        print(f"{name:45} {result.err.strip()}")
    whole = result.err.strip()
    check(result.code == 2, f"{name}: exit code {result.code}, expected 2 ({whole[-300:]!r})")
    lines = result.err.splitlines()
    check(len(lines) == 1 and result.err.endswith("\n"),
          f"{name}: {len(lines)} lines on stderr, expected one: {result.err[:600]!r}")
    check(whole.startswith("tagfield: "), f"{name}: does not begin with 'tagfield: ': {whole!r}")
    check(not whole.startswith(("tagfield: warning", "tagfield: internal")), f"{name}: {whole!r}")
    check(result.out == "", f"{name}: prints on stdout: {result.out[:200]!r}")
    check(result.seconds < MOST_SECONDS, f"{name}: took {result.seconds:.1f} s")
    check(len(whole) < 500, f"{name}: a line of {len(whole)} characters: {whole[:500]!r}")
    for word in ("Traceback", "terminate", "what():", "std::", "Eigen"):
        check(word not in whole, f"{name}: speaks of {word}: {whole!r}")
    for part in [says] if isinstance(says, str) else says:
        check(part.lower() in whole.lower(), f"{name}: does not say {part!r}: {whole!r}")
    if file:
        place = f"{file}:{line}: " if line else str(file)
        check(place in whole, f"{name}: does not name {place!r}: {whole!r}")
    after = files_in(context.folder)
    check(after == before, f"{name}: left or changed {sorted(set(after) ^ set(before)) or 'a file'}")


def line_of(text, part):
    """1-based line at which a part of the text begins."""
    return text[:text.index(part)].count("\n") + 1


def expect_bad_scenario(context, name, text, says, line=None, settings=()):
    path = context.write("bad.yaml", text)
    expect_complaint(context, name, ["run", path, "--out", stranger(context), *settings], says,
                     line, path)


def replaced(text, old, new):
    """`text` with its only occurrence of `old` replaced; fails if there is not exactly one."""
    assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in the base input"
    return text.replace(old, new)


def expect_bad_change(context, old, new, says, line_part=None):
    """Checks the base scenario with `old` replaced; the error must name the line of the change, or the
    first one with `line_part`."""
    text = replaced(SCENARIO, old, new)
    line = line_of(text, line_part) if line_part else line_of(SCENARIO, old)
    expect_bad_scenario(context, new.strip().replace("\n", "⏎"), text, says, line)


# --- Scenarios ------------------------------------------------------------------------------------

@case
def the_base_inputs_are_good(context):
    """The unchanged inputs are valid; otherwise each case below could pass for a wrong reason."""
    path = context.write("base.yaml", SCENARIO)
    context.run_well("run", path, "--out", context.folder / "out")
    world = context.write("hall.sdf", WORLD_WITH_SENSORS)
    context.run_well("check", world)
    context.write("reads.csv", READS)
    context.write("poses.csv", POSES)
    context.write("heights.csv", HEIGHTS)
    context.run_well("localize", "reads.csv", "--poses", "poses.csv", "--tag-heights",
                     "heights.csv", "--out", "localized")


@case
def malformed_yaml(context):
    expect_complaint(context, "missing", ["run", "absent.yaml", "--out", stranger(context)],
                     "no such file", file="absent.yaml")
    expect_complaint(context, "a folder", ["run", context.folder, "--out", stranger(context)],
                     "is a folder", file=context.folder)
    for name, text, says, line in (
            ("tabs", "name: base\nworld:\n\tpath: x\n", "yaml", 3),
            ("unclosed bracket", "name: base\ntags: [1, 2\n", "yaml", None),
            ("unclosed quote", 'name: "base\n', "yaml", None),
            ("two documents' colon", "name: a: b\n", "yaml", 1),
            ("bad indentation", "name: base\n  seed: 1\n", "yaml", None),
            ("list", "- a\n- b\n", "must be a mapping", None),
            ("scalar", "hello\n", "must be a mapping", None),
            ("empty", "", "must be a mapping", None),
            ("comment only", "# nothing\n", "must be a mapping", None),
            ("binary", bytes(range(256)) * 4, "", None),
            ("binary zeros", bytes(1000), "", None),
            ("a deep nest", "a: " + "[" * 5000 + "]" * 5000 + "\n", "", None),
            ("an alias of nothing", "name: *nobody\n", "yaml", 1),
            ("a number as a key's map", "seed: {a: 1}\n", "whole number", 1)):
        expect_bad_scenario(context, name, text, says, line)


@case
def unknown_keys(context):
    for old, new, nearest in (
            ("description:", "descripton:", "description"),
            ("time_step_s:", "timestep_s:", "time_step_s"),
            ("robots:", "robot:", "robots"),
            ("wheel_radius_m:", "wheel_radius:", "wheel_radius_m"),
            ("waypoints:", "way_points:", "waypoints"),
            ("range_m:", "rang_m:", "range_m"),
            ("communication_gain:", "comunication_gain:", "communication_gain"),
            ("travel_m: 0.5, speed", "travel_m: 0.5, sped_m_s: 1, speed", "speed_m_s"),
            ("optional_distribution_params:", "optional_distribution_parms:",
             "optional_distribution_params"),
            (" appears_s: 0", " appear_s: 0", "appears_s"),
            ("disappears_s:", "dissapears_s:", "disappears_s"),
            ("yaw_sigma_deg:", "yaw_sigma_rad:", "yaw_sigma_deg"),
            ("stride_m:", "strides_m:", "stride_m"),
            ("  - name: cart", "  - nam: cart", "name"), ("  - id: near", "  - idd: near", "id"),
            ("travel_m: 0.5", "travl_m: 0.5", "travel_m"),
            ("    position: [1", "    positon: [1", "position")):
        key = "sped_m_s" if "sped" in new else new.split(":")[0].strip(" -")
        expect_bad_change(context, old, new, [f"unknown key '{key}'", f"did you mean '{nearest}'"])
    expect_bad_change(context, "seed: 1", "seed: 1\nseed: 2", "twice", "seed: 2")
    expect_bad_change(context, "track_m: 0.4", "track_m: 0.4\n    track_m: 0.5", "twice",
                      "track_m: 0.5")
    expect_bad_change(context, "seed: 1", "seed: 1\nworld: {path: w.sdf, model_path: x}",
                      ["unknown key", "model_paths"], "world: {")


POSITIVE = "must be greater than 0"
NOT_NEGATIVE = "must be 0 or more"
ANY = None
NUMBERS = (  # a line of the base scenario, and the numbers that it accepts
    ("time_step_s: 0.01", POSITIVE), ("duration_s: 1", POSITIVE), ("real_time: 0", NOT_NEGATIVE),
    ("wheel_radius_m: 0.1", POSITIVE), ("track_m: 0.4", POSITIVE),
    ("    speed_m_s: 0.5", POSITIVE), ("max_turn_rad_s: 1.0", POSITIVE),
    ("look_ahead_m: 0.3", POSITIVE), ("rate_hz: 15", POSITIVE), ("frequency_hz: 865.7e6", POSITIVE),
    ("phase_offset_rad: 0", ANY), ("phase_noise_rad: 0.1", NOT_NEGATIVE),
    ("rssi_noise: 0.01", NOT_NEGATIVE), ("range_m: 7", POSITIVE), ("range_sigma: 0.05",
                                                                   NOT_NEGATIVE),
    ("communication_gain: 3", POSITIVE), ("{travel_m: 0.5", POSITIVE), ("speed_m_s: 0.1", POSITIVE),
    (" appears_s: 0", NOT_NEGATIVE), ("disappears_s: 0.9", POSITIVE),
    ("  sigma_m: 0.01", NOT_NEGATIVE), ("yaw_sigma_deg: 0.5", NOT_NEGATIVE),
    ("time_constant_s: 5", POSITIVE), ("wheel_noise: 0.01", NOT_NEGATIVE),
    ("max_expected_error_m: 0.15", POSITIVE),
    ("max_rms_m: 0.08", POSITIVE), ("tag_height_m: 1", ANY))


@case
def numbers_out_of_their_range(context):
    for line, allowed in NUMBERS:
        key = line.split(":")[0]
        wrong = {".nan": "finite", ".inf": "finite", "seven": "expected a number",
                 "1e300": "within ±100000" if key.endswith("_m") else "within ±1e+15"}
        if "range_m" in key:  # All numbers have the same parser, so the rest is tested for one.
            wrong.update({"-.inf": "finite", "[1]": "must be a number", "1e999": "", '""': "number",
                          "1_000": "number", "0x": "number", "-0.0": POSITIVE, "7 m": "number"})
        if allowed:
            wrong["-1"] = allowed
        if allowed == POSITIVE:
            wrong["0"] = allowed
        for value, says in wrong.items():
            expect_bad_change(context, line, f"{key}: {value}", [key.strip(" {"), says])


@case
def settings_of_methods(context):
    """Settings out of range, or of methods that are not used, are rejected with file and line."""
    line = "stride_m: 0.3"
    for value, says in ((".nan", "finite"), ("seven", "finite number"), ("0", "must be over 0"),
                        ("-1", "must be over 0"), ("1e300", "at most 100000")):
        expect_bad_change(context, line, f"stride_m: {value}", ["stride_m", says])
    expect_bad_change(context, "method: hyperbola", "method: sar",
                      ["stride_m is not used by sar", "a setting of hyperbola"], line)
    expect_bad_change(context, line, "max_hyperbolae: 2.5", "whole number")
    expect_bad_change(context, line, "neighbours: 4",
                      ["neighbours is not used by hyperbola", "landmarc"])


@case
def numbers_beyond_reason(context):
    """Finite and positive numbers that are impossible to simulate are rejected immediately."""
    for line, value in (("time_step_s: 0.01", "1e-10"), ("time_step_s: 0.01", "1e10"),
                        ("duration_s: 1", "1e10"), (" appears_s: 0", "1e10"),
                        ("disappears_s: 0.9", "1e10")):
        key = line.split(":")[0]
        expect_bad_change(context, line, f"{key}: {value}", [key.strip(), "s"])
    expect_bad_change(context, "[[0, 2, 0, 1], [1, 3, 0, 1]]", "[[1e10, 2, 0, 1]]", "trajectory")
    for line, value, says in (("rate_hz: 15", "1e9", "rate_hz must be from"),
                              ("rate_hz: 15", "1e-12", "rate_hz must be from"),
                              ("frequency_hz: 865.7e6", "1e-300", "wavelength")):
        key = line.split(":")[0]
        # Reported for the line of the antenna, as several of its keys are involved.
        expect_bad_change(context, line, f"{key}: {value}", says, "- name: mast")


@case
def places_beyond_any_hall(context):
    """Valid numbers, but positions that are too far away to be drawn: no results are written."""
    for old, new, element in (
            ("position: [1, 2, 1]", "position: [1, 1e15, 1]", "tags[0].position"),
            ("start: [0, 0, 0]", "start: [-2e5, 0, 0]", "robots[0].start"),
            ("waypoints: [[1, 0], [1, 1]]", "waypoints: [[1, 0], [1, 1e15]]", "robots[0].waypoints[1]"),
            ("pose: [2, 2, 1]", "pose: [2, 2, 1e15, 0, 0, 0]", "antennas[1].pose"),
            ("[1, 3, 0, 1]]", "[1, 3, 1e15, 1]]", "tags[1].trajectory[1]")):
        expect_bad_change(context, old, new, [element, "must be within ±100000 m"])
    expect_bad_change(context, "id: near", 'id: "ne\\0ar"', ["tags[0].id", "NUL"])


@case
def lists_and_words_of_the_wrong_kind(context):
    for old, new, says in (
            ("start: [0, 0, 0]", "start: [0, 0]", "must have 3 numbers, has 2"),
            ("start: [0, 0, 0]", "start: 0", "must be a list"),
            ("start: [0, 0, 0]", "start: [0, 0, .nan]", "finite"),
            ("    start: [0, 0, 0]\n", "", "has no 'start' (expected start: [x, y, yaw] in m and rad)"),
            ("waypoints: [[1, 0], [1, 1]]", "waypoints: [[1, 0], [1, 1, 1]]", "2 numbers, has 3"),
            ("waypoints: [[1, 0], [1, 1]]", "waypoints: [1, 0]", "must be a list"),
            ("waypoints: [[1, 0], [1, 1]]", "waypoints: [[1, .inf]]", "finite"),
            ("waypoints: [[1, 0], [1, 1]]", "waypoints: [[1, one]]", "expected a number"),
            ("pose: [0, 0, 1]", "pose: [0, 0, 1, 0]", "roll, pitch, yaw"),
            ("pose: [0, 0, 1]", "pose: [0, 0, .nan]", "finite"),
            ("    pose: [0, 0, 1]\n", "", "has no 'pose' (expected pose: [x, y, z] or [x, y, z, roll, pitch, yaw]"),
            ("position: [1, 2, 1]", "position: [1, 2]", "must have 3 numbers"),
            ("position: [1, 2, 1]", "position: [1, 2, .nan]", "finite"),
            ("    position: [1, 2, 1]\n", "", "has no 'position' (expected position: [x, y, z] in m)"),
            ("position: [1, 2, 1]", "position: [1, 2, 1]\n    trajectory: [[0, 1, 1, 1]]",
             ["position", "trajectory"]),
            ("[[0, 2, 0, 1], [1, 3, 0, 1]]", "[]", "at least one row"),
            ("[[0, 2, 0, 1], [1, 3, 0, 1]]", "[[0, 2, 0]]", "must have 4 numbers"),
            ("[[0, 2, 0, 1], [1, 3, 0, 1]]", "[[1, 2, 0, 1], [0, 3, 0, 1]]", "must rise"),
            ("[[0, 2, 0, 1], [1, 3, 0, 1]]", "[[0, 2, 0, 1], [0, 3, 0, 1]]", "must rise"),
            ("refine: true", "refine: perhaps", "expected true or false"),
            ("method: hyperbola", "method: parabola", ["not known", "hyperbola"]),
            ("source: noisy", "source: noizy", ["not known", "noisy"]),
            ("model: paper", "model: papier", ["papier", "expected paper, link_budget, multipath"]),
            ("tag_height_m: 1", "tag_heights: knwon", ["not known", "known"]),
            ("seed: 1", "seed: -1", "whole number"),
            ("seed: 1", "seed: 1.5", "whole number"),
            ("seed: 1", "seed: 99999999999999999999999", "whole number"),
            ("name: base", "name: [a]", "must be a text"),
            ("name: base", 'name: ""', "must be a text"),
            ("id: near", "id: [near]", "must be a text"),
            ("disappears_s: 0.9", "disappears_s: 0.9\n    appears_s: 0.9", "later than appears_s"),
            ("lift: {travel_m: 0.5, speed_m_s: 0.1}", "lift: 0.5", "must be a mapping"),
            ("lift: {travel_m: 0.5, speed_m_s: 0.1}", "lift: {speed_m_s: 1}", "has no 'travel_m'")):
        path = replaced(SCENARIO, old, new)
        expect_bad_scenario(context, new.strip() or f"without {old.strip()}", path, says)
        # The error must name a line: that of the fault, or that where the incomplete element begins.
        complaint = context.run("check", context.folder / "bad.yaml").err
        check("bad.yaml:" in complaint, f"{new or old!r}: names no line: {complaint!r}")
    expect_bad_scenario(context, "robots is a mapping", "robots: {name: a}\n", "must be a list", 1)
    expect_bad_scenario(context, "antennas of numbers", "antennas: [1]\n", "must be a mapping", 1)


@case
def distributions(context):
    given = ("optional_distribution: normal_distribution\n"
             "    optional_distribution_params: [0, 0.1]")
    for name, parameters, says in (
            ("normal", "[0, 0.1]", ["normal", "normal_distribution"]),
            ("norml_distribution", "[0, 0.1]", "normal_distribution"),
            ("normal_distribution", "[0]", ["normal_distribution", "2"]),
            ("normal_distribution", "[0, 1, 2]", ["normal_distribution", "2"]),
            ("normal_distribution", "[0, -1]", "normal_distribution"),
            ("normal_distribution", "[.nan, 1]", "finite"),
            ("normal_distribution", "zero", "must be a list"),
            ("uniform_real_distribution", "[0.1]", "2"),
            ("uniform_real_distribution", "[1, 0]", "uniform_real_distribution"),
            ("exponential_distribution", "[1, 2]", ["exponential_distribution", "1"]),
            ("exponential_distribution", "[0]", "exponential_distribution"),
            ("gamma_distribution", "[1]", "2"),
            ("gamma_distribution", "[0, 1]", "gamma_distribution"),
            ("weibull_distribution", "[]", "2"),
            ("weibull_distribution", "[1, -1]", "weibull_distribution"),
            ("lognormal_distribution", "[1, 2, 3]", "2"),
            ("lognormal_distribution", "[1, -2]", "lognormal_distribution"),
            ("chi_squared_distribution", "[1, 2]", "1"),
            ("chi_squared_distribution", "[-1]", "chi_squared_distribution"),
            ("cauchy_distribution", "[1]", "2"),
            ("cauchy_distribution", "[0, 0]", "cauchy_distribution"),
            ("none", "[1]", "none")):
        text = replaced(SCENARIO, given, f"optional_distribution: {name}\n"
                        f"    optional_distribution_params: {parameters}")
        line = line_of(text, "optional_distribution:")
        path = context.write("bad.yaml", text)
        expect_complaint(context, f"{name} {parameters}",
                         ["run", path, "--out", stranger(context)], says, file=path)
        complaint = context.run("check", path).err
        check(f"bad.yaml:{line}:" in complaint or f"bad.yaml:{line + 1}:" in complaint,
              f"{name} {parameters}: names another line: {complaint!r}")
    without = replaced(SCENARIO, given, "optional_distribution: normal_distribution")
    expect_bad_scenario(context, "no parameters", without, ["normal_distribution", "2"],
                        line_of(without, "optional_distribution:"))


@case
def names_that_clash_or_lead_nowhere(context):
    expect_bad_change(context, "- id: far", "- id: near # second", "near", "- id: near # second")
    expect_bad_change(context, "- name: gate", "- name: mast # second", "mast",
                      "- name: mast # second")
    expect_bad_change(context, "on: cart", "on: crat", ["robot", "crat"], "- name: mast")
    expect_bad_change(context, "- id: near", "- id: near\n    on: nobody", ["robot", "nobody"],
                      "- id: near")
    two_robots = replaced(SCENARIO, "antennas:", "  - {name: cart, start: [1, 1, 1]}\nantennas:")
    expect_bad_scenario(context, "two robots of one name", two_robots, ["robot", "cart"], line_of(two_robots, "  - {name: cart"))
    no_waypoints = replaced(replaced(SCENARIO, "    waypoints: [[1, 0], [1, 1]]\n", ""),
                            "duration_s: 1\n", "")
    expect_bad_scenario(context, "neither duration nor waypoints", no_waypoints, "duration_s")
    start = SCENARIO.index("antennas:\n")
    tags = SCENARIO.index("tags:\n")
    pose = SCENARIO.index("pose:\n  source")
    expect_bad_scenario(context, "no antennas", SCENARIO[:start] + SCENARIO[tags:], "no antennas")
    expect_bad_scenario(context, "no tags", SCENARIO[:tags] + SCENARIO[pose:], "no tags")


@case
def tag_tables(context):
    table = "tag,x_m,y_m,z_m\na,1,2,3\nb,2,2,3\n"
    text = replaced(SCENARIO, "pose:\n  source", "tag_table: tags.csv\npose:\n  source")
    for name, change, says, line in (
            ("missing", None, "no such file", None),
            ("no column", table.replace("z_m", "z"), "z_m", 1),
            ("text", table.replace("b,2", "b,two"), "expected a finite number", 3),
            ("nan", table.replace("b,2", "b,nan"), "expected a finite number", 3),
            ("no name", table.replace("b,2", ",2"), "tag is empty", 3),
            ("extra field", table.replace("b,2", "b,2,2"), "fields", 3),
            ("twice", table.replace("b,2", "a,2"), "a", 3),
            ("twice with the scenario", table.replace("b,2", "near,2"), "near", 3),
            ("empty", "", "is empty", None)):
        path = context.write("bad.yaml", text)
        if change is not None:
            context.write("tags.csv", change)
        expect_complaint(context, f"tag_table {name}", ["run", path, "--out", stranger(context)],
                         says, line, context.folder / "tags.csv")


# --- --set and other arguments --------------------------------------------------------------------

@case
def settings_on_the_command_line(context):
    path = context.write("good.yaml", SCENARIO)
    for setting, says in (
            ("seed", "key.path=value"), ("=1", "key.path=value"), ("", "key.path=value"),
            ("sede=1", ["--set", "unknown key", "seed"]), ("seed=x", ["--set", "whole number"]),
            ("antennas.nobody.range_m=1", ["--set", "nobody"]),
            ("antennas.7.range_m=1", ["--set", "7"]),
            ("antennas.mast.rang_m=1", ["--set", "range_m"]),
            ("antennas.mast.range_m=-1", ["--set", POSITIVE]),
            ("antennas.mast.range_m=.nan", ["--set", "finite"]),
            ("antennas.mast.frequency_hz=0", ["--set", POSITIVE]),
            ("antennas.mast.range_m.x=1", ["--set", "range_m"]),
            ("pose..sigma_m=1", ["--set", "between the dots"]),
            (".seed=1", ["--set", "between the dots"]),
            ("pose.sigma_m=[1", ["--set", "YAML"]),
            ("pose.source=perfect", ["--set", "not known"]),
            ("robots.cart.start=[0,0]", ["--set", "3 numbers"]),
            ("tags.near.id=far", "far"),
            ("world.path=absent.sdf", ["absent.sdf", "no such file"])):
        for command in (["run", path, "--out", stranger(context)], ["check", path]):
            expect_complaint(context, f"{command[0]} --set {setting}",
                             [*command, "--set", setting], says)


@case
def arguments(context):
    path = context.write("good.yaml", SCENARIO)
    context.write("reads.csv", READS)
    context.write("poses.csv", POSES)
    run = ["run", path, "--out", stranger(context)]
    localize = ["localize", "reads.csv", "--poses", "poses.csv", "--out", stranger(context)]
    for command, says in (
            (["ran"], "ran"), (["frobnicate", path], "frobnicate"),
            (["--nonsense"], "nonsense"), (["run"], "SCENARIO"),
            (["localize", "reads.csv"], "--poses"), (["report"], "DIR"), (["check"], "FILE"),
            (["run", "scenarios/conveyor.yaml"], "no such file; the one that comes with Tagfield is"),
            (["check", "worlds/portal_room.sdf"], "the one that comes with Tagfield is"),
            (["gazebo", "scenarios/conveyor.yaml"], "the one that comes with Tagfield is"),
            (["bench", "scenarios/bench/real.yaml"], "the one that comes with Tagfield is"),
            (["sweep", "scenarios/sweep/robot.yaml"], "the one that comes with Tagfield is"),
            (["plan", "scenarios/nope.yaml"], "scenarios/nope.yaml: no such file"),
            (["run", context.write("suite.yaml", "methods: [ml]\nscenario: good.yaml\nsweep: {}\n")],
             "is a suite, not a scenario"),
            ([*run, "--seeds", "0"], "seeds"), ([*run, "--seeds", "-1"], "seeds"),
            ([*run, "--seeds", "many"], "seeds"), ([*run, "--seeds", "1.5"], "seeds"),
            ([*run, "--seeds"], "seeds"), ([*run, "--seed", "-1"], "seed"),
            ([*run, "--seed", "x"], "seed"), ([*run, "--seed", "1.5"], "seed"),
            ([*run, "--seed", "99999999999999999999"], "seed"),
            ([*run, "--threads", "0"], "threads"), ([*run, "--threads", "-2"], "threads"),
            ([*run, "--threads", "two"], "threads"), ([*run, "--threads", "1000000"], "threads"),
            ([*run, "--frob"], "--frob"), ([*run, "another.yaml"], "another.yaml"),
            ([*localize, "--method", "parabola"], "method"),
            ([*localize, "--tag-height", "tall"], "tag-height"),
            ([*localize, "--tag-height", "nan"], "--tag-height: 'nan' is not a number"),
            ([*localize, "--pose-sigma", "nan"], "--pose-sigma: 'nan' is not a number"),
            ([*localize, "--map-sigma", "NaN"], "--map-sigma: 'NaN' is not a number"),
            ([*localize, "--box", "nan", "0", "1", "1"], "--box: 'nan' is not a number"),
            ([*localize, "--frequency", "nan"], "--frequency: 'nan' is not a carrier in Hz"),
            ([*localize, "--frequency", "-1"], "'-1' is not a carrier in Hz, from 1e+06 to 1e+11"),
            ([*localize, "--frequency", "865.7"], "is it in MHz?"),
            ([*localize, "--pose-sigma", "0.1", "--pose-time-constant", "0"],
             "'0' is not a number greater than 0"),
            ([*localize, "--tag-height", "inf"], "height"),
            ([*localize, "--set", "stride_m=0.5"], ["stride_m is not used by auto", "hyperbola"]),
            ([*localize, "--method", "hyperbola", "--set", "stride_m=0"], "must be over 0"),
            ([*localize, "--method", "hyperbola", "--set", "stride_m=nan"], "finite"),
            ([*localize, "--method", "hyperbola", "--set", "strid_m=1"], "did you mean 'stride_m'"),
            ([*localize, "--method", "sar", "--set", "maxima=1.5"], "whole number"),
            ([*localize, "--threads", "0"], "threads"),
            (["check", context.write("notes.txt", "x")], "YAML"),
            (["check", context.folder], "expected")):
        expect_complaint(context, " ".join(map(str, command)), command, says)


# --- Worlds ---------------------------------------------------------------------------------------

def expect_bad_world(context, name, text, says, line=None, file="hall.sdf"):
    """Checks an invalid world with `check` and `run`, which must give the same error."""
    if text is not None:
        context.write("hall.sdf", text)
    scenario = replaced(SCENARIO, "robots:", "world: {path: hall.sdf}\nrobots:")
    context.write("in_hall.yaml", scenario)
    for command in (["check", "hall.sdf"], ["run", "in_hall.yaml", "--out", stranger(context)]):
        expect_complaint(context, f"{command[0]}: {name}", command, says, line, file)


def with_mesh(uri):
    return MODEL.replace("GEOMETRY", f"<mesh><uri>{uri}</uri></mesh>")


@case
def malformed_worlds(context):
    expect_bad_world(context, "missing world", None, "no such file")
    for name, text, says, line in (
            ("not XML", "once upon a time\n", "", None),
            ("empty", "", "", None),
            ("binary", bytes(range(256)), "", None),
            ("unclosed element", WORLD.replace("</model>", ""), "", None),
            ("cut off", WORLD[:200], "", None),
            ("another root", "<html><body/></html>\n", "sdf", None),
            ("no world", '<sdf version="1.6">\n</sdf>\n', "holds no world", 1),
            ("an old version", WORLD.replace('version="1.6"', 'version="1.0"'), "version 1.0", 2),
            ("text in a pose", WORLD.replace("<static>", "<pose>a b c 0 0 0</pose><static>"),
             "pose", 5),
            ("nan in a pose", WORLD.replace("<static>", "<pose>nan 0 0 0 0 0</pose><static>"),
             "pose", 5),
            ("a box of NaN size", WORLD.replace("1 1 1</size>", "1 nan 1</size>"), "size", 7),
            ("two corners of a box", WORLD.replace("1 1 1</size>", "1 1</size>"), "3 numbers", 7)):
        expect_bad_world(context, name, text, says, line)


PHYSICS = """\
name: physics
model: multipath
duration_s: 0.2
tag_profile: tag.yaml
without: [diffuse]
world:
  path: hall.sdf
  default_material: concrete
  min_facet_m2: 0.1
  materials: {walls: brick}
materials:
  - {name: foam, permittivity: 1.05, conductivity_s_m: 0.001, wall_m: 0.1, crossing_db: 1}
antennas:
  - name: gate
    pose: [2, 1, 1]
    profiles: [reader.yaml]
    transmit_power_dbm: 30
    cable_loss_db: 1
    pattern: patch
    gain_dbi: 8
    beam_width_deg: 65
    polarization: right_circular
    channel_plan: etsi_low
    carriers_hz: [865.7e6, 867.5e6]
    reflection_order: 2
    inventory: gen2
    start_q: 4
    tari_us: 25
    blf_khz: 250
    sensitivity_dbm: -84
tags:
  - {id: near, position: [1, 1, 1], rpy: [0, 0, 1], sensitivity_dbm: -20}
"""
TAG_PROFILE = """\
name: a tag
kind: tag
figures:
  gain_dbi: {value: 2, source: "a book"}
"""
READER_PROFILE = """\
name: a reader
kind: reader
figures:
  phase_steps: {value: 4096, source: "a manual"}
"""


@case
def physics_that_cannot_be(context):
    """Each error states the fault, the allowed range or words, and the line."""
    context.write("hall.sdf", HALL)
    context.write("tag.yaml", TAG_PROFILE)
    context.write("reader.yaml", READER_PROFILE)
    context.run_well("run", context.write("base.yaml", PHYSICS), "--no-page", "--out",
                     context.folder / "good")
    for old, new, says in (
            ("model: multipath", "model: multypath", "expected paper, link_budget, multipath"),
            ("without: [diffuse]", "without: [difuse]", "did you mean 'diffuse'"),
            ("default_material: concrete", "default_material: concret",
             "did you mean 'concrete'"),
            ("min_facet_m2: 0.1", "min_facet_m2: -1", "0 or more"),
            ("{walls: brick}", "{walls: brik}", "did you mean 'brick'"),
            ("permittivity: 1.05", "permittivity: -1.05", "from 1 to 10000, is -1.05"),
            ("conductivity_s_m: 0.001", "conductivity_s_m: -3", "0 or more, is -3"),
            ("wall_m: 0.1", "wall_m: 0", "greater than 0"),
            ("crossing_db: 1}", "crossing_db: -1}", "from 0 to 300 dB, is -1"),
            ("transmit_power_dbm: 30", "transmit_power_dbm: 300", "from -50 to 60, is 300"),
            ("cable_loss_db: 1", "cable_loss_db: -1", "from 0 to 100, is -1"),
            ("pattern: patch", "pattern: dish", "expected isotropic, patch, dipole, table"),
            ("gain_dbi: 8", "gain_dbi: 80", "from -60 to 40 dBi, is 80"),
            ("beam_width_deg: 65", "beam_width_deg: 650", "from 2 to 179 degrees"),
            ("polarization: right_circular", "polarization: round", "expected linear"),
            ("channel_plan: etsi_low", "channel_plan: etsy_low", "did you mean 'etsi_low'"),
            ("carriers_hz: [865.7e6, 867.5e6]", "carriers_hz: [865.7e6, 915e6]",
             "carrier 915 MHz is outside the plan's band, 865 to 868 MHz"),
            ("reflection_order: 2", "reflection_order: 4", "from 0 to 3, is 4"),
            ("inventory: gen2", "inventory: gen3", "expected none, gen2"),
            ("start_q: 4", "start_q: 16", "from 0 to 15"),
            ("start_q: 4", "min_q: 5", "min_q must be from 0 to 4 (start_q, the Q of the first round), is 5"),
            ("start_q: 4", "max_q: 3", "max_q must be from 4 (start_q, the Q of the first round) to 15, is 3"),
            ("tari_us: 25", "tari_us: 30", "6.25"),
            ("blf_khz: 250", "blf_khz: 900", "640"),
            ("sensitivity_dbm: -84", "sensitivity_dbm: 30",
             "sensitivity_dbm must be below transmit_power_dbm (30), is 30"),
            ("sensitivity_dbm: -20}", "sensitivity_dbm: 29.9999, detuning_db: -2}",
             "detuning_db must be from 0 to 100"),
            ("sensitivity_dbm: -20}", "sensitivity_dbm: 30}",
             "sensitivity_dbm must be below the antennas' transmit_power_dbm (30)"),
            ("profiles: [reader.yaml]", "profiles: [tag.yaml]", "is a tag profile"),
            ("profiles: [reader.yaml]", "profiles: [absent.yaml]", "absent.yaml': there is no such file"),
            ("cable_loss_db: 1", "cable_los_db: 1", "did you mean 'cable_loss_db'")):
        text = replaced(PHYSICS, old, new)
        expect_bad_scenario(context, new, text, says)
    for name, file, text, says in (
            ("a figure without a source", "tag.yaml", TAG_PROFILE.replace(', source: "a book"', ""),
             "has no 'source'"),
            ("a figure that is none", "tag.yaml", TAG_PROFILE.replace("gain_dbi", "gain_db"),
             "did you mean 'gain_dbi'"),
            ("a profile of no kind", "reader.yaml", READER_PROFILE.replace("reader\nf", "boat\nf"),
             "'boat'")):
        context.write(file, text)
        expect_complaint(context, name, ["run", "base.yaml", "--out", stranger(context)], says,
                         file=file)
        context.write("tag.yaml", TAG_PROFILE)
        context.write("reader.yaml", READER_PROFILE)


@case
def odd_physics_gets_warnings(context):
    context.write("hall.sdf", HALL)
    context.write("tag.yaml", TAG_PROFILE)
    context.write("reader.yaml", READER_PROFILE)
    for old, new, says in (
            ("gain_dbi: 8", "gain_dbi: 14", "a gain of 14.0 dBi is more than"),
            ("transmit_power_dbm: 30", "transmit_power_dbm: 33", "channel plan 'etsi_low' allows"),
            ("materials: {walls: brick}", "materials: {wals: brick}", "no solid part"),
            ("  materials: {walls: brick}\n", "", "materials are guessed from names")):
        path = context.write("odd.yaml", replaced(PHYSICS, old, new))
        result = context.run_well("run", path, "--no-page", "--out", context.folder / "out")
        check_in(says, result.err, new)
    # A stated default is no guess.
    context.write("hall.sdf", replaced(HALL.replace("box_", "part_"), 'model name="walls"', 'model name="shell"'))
    stated = replaced(PHYSICS, "  materials: {walls: brick}\n", "")
    for text, is_guess in ((stated, False), (replaced(stated, "  default_material: concrete\n", ""), True)):
        result = context.run_well("check", context.write("default.yaml", text))
        said = result.out + result.err
        check_equal("materials are guessed from names: concrete for shell" in said, is_guess, said)
        check_equal("guessed" in said, is_guess, said)


@case
def tags_that_appear_after_the_run_are_warned_of(context):
    path = context.write("late.yaml", """\
robots: [{name: r, start: [0, 0, 0], waypoints: [[1, 0]]}]
antennas: [{name: a, on: r, pose: [0, 0, 1]}]
tags:
  - {id: here, position: [1, 1, 1]}
  - {id: late, position: [2, 1, 1], appears_s: 100}
""")
    says = ":5: tag 'late' appears at 100 s, after the run's end at "
    # That a robot has arrived is known only after the run.
    check_in(says, context.run_well("run", path, "--no-page", "--out", "out").err, "run")
    check_in(says, context.run_well("run", path, "--record-only", "--out", "recorded").err, "run --record-only")
    for command in (("check", path), ("stream", path, "--speed", "0")):
        result = context.run_well(*command, "--set", "duration_s=2")
        check_in(says + "2 s: it is not read", result.err, f"{command}")
        result = context.run_well(*command, "--set", "duration_s=120")
        check("late" not in result.err, f"{command}: {result.err!r}")


@case
def check_tells_which_materials_waves_meet(context):
    for name, text in (("hall.sdf", HALL), ("tag.yaml", TAG_PROFILE), ("reader.yaml", READER_PROFILE)):
        context.write(name, text)
    path = context.write("base.yaml", PHYSICS)
    described = json.loads(context.run_well("check", path, "--json").out)
    check_equal(described["material_rules"], 1, "rules")
    materials = {entry["material"]: entry["collisions"] for entry in described["materials_for_waves"]}
    check_equal(sum(materials.values()), len(described["collisions"]), "collisions with a material")
    check(materials.get("brick", 0) > 0, f"no brick: {materials}")
    text = context.run_well("check", path).out
    check_in(f"materials for waves: {len(materials)}, by 1 rule\n", text, "check")
    # Waves of the paper's model meet nothing.
    check("for waves" not in context.run_well("check", context.shipped("paper_warehouse")).out, "paper's model")


@case
def missing_models_and_meshes(context):
    include = WORLD.replace("    <model", "    <include><uri>model://nobody</uri></include>\n"
                            "    <model", 1)
    expect_bad_world(context, "missing model", include, "nobody", 4)
    empty_folder = WORLD.replace("    <model", "    <include><uri>model://hollow</uri></include>\n"
                                 "    <model", 1)
    (context.folder / "models/hollow").mkdir(parents=True)
    expect_bad_world(context, "a model folder without model.sdf", empty_folder, "hollow", 4)
    for name, uri in (("missing mesh", "absent.stl"), ("missing model's mesh", "model://no/a.dae"),
                      ("missing mesh by file://", "file:///absent/absent.dae"),
                      ("missing absolute mesh", "/absent/absent.obj")):
        expect_bad_world(context, name, with_mesh(uri), [uri.rsplit("/", maxsplit=1)[-1]], 7)


@case
def broken_meshes(context):
    dae = '<?xml version="1.0"?>\n<COLLADA version="1.4.1"><library_geometries><geometry id="g">'
    good_stl = context.write("good.stl", TETRAHEDRON_STL)
    context.write("hall.sdf", with_mesh("good.stl"))
    context.run_well("check", "hall.sdf")
    good_stl.unlink()
    for name, content in (
            ("cut.dae", dae), ("text.dae", "not a mesh\n"), ("empty.dae", ""),
            ("empty.stl", ""), ("text.stl", "not a mesh\n"), ("hollow.stl", "solid s\nendsolid s\n"),
            ("short.stl", bytes(80) + (1000).to_bytes(4, "little") + bytes(50)),
            ("nan.stl", TETRAHEDRON_STL.replace("vertex 1 0 0", "vertex nan 0 0")),
            ("text.obj", "not a mesh\n"), ("empty.obj", ""), ("hollow.obj", "v 0 0 0\nv 1 0 0\n"),
            ("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
            ("unknown.xyz", "1 2 3\n")):
        context.write(name, content)
        expect_bad_world(context, name, with_mesh(name), name, file=name)
        complaint = context.run("check", "hall.sdf").err
        check("hall.sdf:7" in complaint, f"{name}: does not name the world's line: {complaint!r}")


@case
def bad_sensors_in_a_world(context):
    for old, new, says in (
            ("<frequency>865.7e6", "<frequency>-1", "frequency"),
            ("<frequency>865.7e6", "<frequency>0", "frequency"),
            ("<frequency>865.7e6", "<frequency>nan", "frequency"),
            ("<frequency>865.7e6", "<frequency>fast", "expected a number"),
            ("<noisephi>0.1", "<noisephi>-0.1", "noisephi"),
            ("<noiserssi>0.008", "<noiserssi>-1", "noiserssi"),
            ("<range>7", "<range>0", "range"), ("<range>7", "<range>-7", "range"),
            ("<communication_gain>1", "<communication_gain>0", "gain"),
            ("<update_rate>15", "<update_rate>-15", "rate"),
            ("<update_rate>15", "<update_rate>0", "rate"),
            (">none<", ">sometimes<", "sometimes"),
            (">none<", ">normal_distribution<", "normal_distribution")):
        text = replaced(WORLD_WITH_SENSORS, old, new)
        expect_bad_world(context, new, text, says)
        complaint = context.run("check", "hall.sdf").err
        check("hall.sdf:" in complaint, f"{new}: names no line: {complaint!r}")


@case
def worlds_without_antennas_or_tags(context):
    context.write("hall.sdf", WORLD)
    path = context.write("empty_hall.yaml", "world: {path: hall.sdf}\nduration_s: 1\n")
    expect_complaint(context, "world without antennas", ["run", path, "--out", stranger(context)],
                     ["no antennas", "world"], file=path)
    path = context.write("no_tags.yaml", "world: {path: hall.sdf}\nduration_s: 1\n"
                         "antennas: [{name: a, pose: [0, 0, 1]}]\n")
    expect_complaint(context, "world without tags", ["run", path, "--out", stranger(context)],
                     ["no tags", "world"], file=path)
    context.write("no_world.yaml", "world: {path: }\nduration_s: 1\n")
    expect_complaint(context, "no path of the world", ["run", "no_world.yaml"], "--set world.path",
                     1, "no_world.yaml")


@case
def two_tags_of_one_name_in_world_and_scenario(context):
    context.write("hall.sdf", WORLD_WITH_SENSORS)
    text = ("world: {path: hall.sdf}\nduration_s: 1\ntags:\n"
            "  - {id: parcel, position: [0, 0, 0]}\n")
    path = context.write("clash.yaml", text)
    expect_complaint(context, "a tag of the world's name", ["run", path, "--out",
                                                           stranger(context)], ["parcel", "hall.sdf"])
    path = context.write("clash.yaml", "world: {path: hall.sdf}\nduration_s: 1\nantennas:\n"
                         "  - {name: door, pose: [0, 0, 0]}\n")
    expect_complaint(context, "an antenna of the world's name",
                     ["run", path, "--out", stranger(context)], "door")


# --- Robots that navigate autonomously ------------------------------------------------------------

def write_hall(context):
    context.write("hall.sdf", HALL)
    context.write("hall.yaml", HALL_YAML)
    context.write("hall.pgm", hall_pgm())


@case
def maps_that_are_no_maps(context):
    write_hall(context)
    path = context.write("driven.yaml", NAVIGATION)
    context.run_well("run", path, "--out", "good", "--no-page")
    whole = hall_pgm()
    for name, content, says, file in (
            ("hall.pgm", b"", "", "hall.pgm"), ("hall.pgm", whole[:2000], "", "hall.pgm"),
            ("hall.pgm", whole.replace(b"84 54", b"84 55"), "", "hall.pgm"),
            ("hall.pgm", whole.replace(b"84 54", b"84000000 54000000"), "", "hall.pgm"),
            ("hall.pgm", whole.replace(b"84 54", b"0 0"), "", "hall.pgm"),
            ("hall.pgm", whole.replace(b"84 54", b"-84 54"), "", "hall.pgm"),
            ("hall.pgm", b"an image\n", "", "hall.pgm"), ("hall.pgm", None, "no such file", "hall.pgm"),
            ("hall.pgm", hall_pgm(254), "no occupied cell", "hall.yaml"),
            ("hall.pgm", hall_pgm(0), "no free cell", "hall.yaml"),
            ("hall.pgm", hall_pgm(205), "no free cell", "hall.yaml"),
            ("hall.yaml", "", "", "hall.yaml"), ("hall.yaml", None, "no such file", "hall.yaml"),
            ("hall.yaml", HALL_YAML.replace("hall.pgm", "none.pgm"), "no such file", "none.pgm"),
            ("hall.yaml", HALL_YAML.replace("0.1\n", "0\n"), "resolution", "hall.yaml"),
            ("hall.yaml", HALL_YAML.replace("0.1\n", ".nan\n"), "resolution", "hall.yaml"),
            ("hall.yaml", HALL_YAML.replace("0.0]", "0.5]"), "origin", "hall.yaml"),
            ("hall.yaml", HALL_YAML.replace("0.65", "0.1"), "thresh", "hall.yaml"),
            ("hall.yaml", HALL_YAML.replace("image: hall.pgm", ""), "image", "hall.yaml")):
        write_hall(context)
        if content is None:
            (context.folder / name).unlink()
        else:
            context.write(name, content)
        expect_complaint(context, f"{name} {content and content[:12]!r}",
                         ["run", path, "--out", stranger(context)], says, file=file)


@case
def robots_in_walls(context):
    write_hall(context)
    for old, new, says, line in (
            ("start: [0, 0, 0]", "start: [3.8, 0, 0]", "robots[0].start", 5),
            ("start: [0, 0, 0]", "start: [-2, -0.7, 0]", "robots[0].start", 5),
            ("start: [0, 0, 0]", "start: [1.9, 1.5, 0]", "robots[0].start", 5),
            ("[300, -1, 0, 0]", "[3, 1.9, 1, 0]", "robots[0].kidnapped[0]", 8),
            ("[300, -1, 0, 0]", "[3], [4, -2, -1, 0]", "robots[0].kidnapped[1]", 8)):
        text = replaced(NAVIGATION, old, new)
        expect_bad_scenario(context, new, text, [says, "wall or an obstacle"], line)
        path = context.write("bad.yaml", text)
        expect_complaint(context, f"check, {new}", ["check", path], says, line, path)


@case
def robots_that_are_in_each_others_way(context):
    """They don't avoid one another, which is told; they must not start in the same place."""
    write_hall(context)
    second = "  - {{name: second, start: [{}, 0, 3.14159], goals: [[-0.5, 0, 3.14159]]}}\nantennas:\n"
    text = replaced(NAVIGATION, "    kidnapped: [[300, -1, 0, 0]]\n", "")
    expect_bad_scenario(context, "one start", replaced(text, "antennas:\n", second.format(0.2)),
                        ["robots[1].start (0.20, 0.00) puts the robot into robot 'cart'"], 8)
    path = context.write("two.yaml", replaced(text, "antennas:\n", second.format(1.2)))
    result = context.run_well("run", path, "--no-page", "--out", "out")
    check_in("robots 'cart' and 'second' drive through each other at ", result.err, "warning")
    navigation = read_json(context.folder / "out/summary.json")["navigation"]
    check_equal(navigation["closest_m"], 0, "closest_m")
    check(navigation["collisions"] > 0, "collisions")
    far = replaced(text, "start: [0, 0, 0]", "start: [50, 0, 0]")
    expect_bad_scenario(context, "beside the map", far, ["robots[0].start (50.00, 0.00) is not on the map"], 5)
    result = context.run_well("run", context.write("late.yaml", NAVIGATION), "--no-page", "--out", "late")
    check_in("late.yaml:8: robot 'cart' would be kidnapped at 300 s, after the run's end", result.err, "warning")


@case
def ways_to_find_that_make_no_sense(context):
    write_hall(context)
    for old, new, says in (
            ("  mode: slam", "  mode: slam\n  start: anywhere", ["navigation.start", "unknown"]),
            ("goals: [[0.4, 0, 0]]", "goals: [[0.4, 0]]", "robots[0].goals[0]"),
            ("goals: [[0.4, 0, 0]]", "goals: [[0.4, 0, .nan]]", "robots[0].goals[0]"),
            ("goals: [[0.4, 0, 0]]", "random_goals: 0", "robots[0].random_goals"),
            ("goals: [[0.4, 0, 0]]", "random_goals: 1e9", "robots[0].random_goals"),
            ("[[300, -1, 0, 0]]", "[[300, -1, 0]]", ["robots[0].kidnapped[0]", "[t, x, y, yaw]"]),
            ("[[300, -1, 0, 0]]", "[[30], [20]]", ["robots[0].kidnapped[1]", "later"]),
            ("[[300, -1, 0, 0]]", "[[-1]]", "robots[0].kidnapped[0]"),
            ("  mode: slam", "  mode: odometry", ["robots[0].goals", "navigation: slam"]),
            ("{beams: 91}", "{beams: 1}", "navigation.laser.beams"),
            ("{beams: 91}", "{first_angle_deg: 90, last_angle_deg: -90}",
             "navigation.laser.last_angle_deg makes the laser see from 90 to -90 degrees"),
            ("{beams: 91}", "{first_angle_deg: -400}", "navigation.laser.first_angle_deg is -400"),
            ("radius_m: 0.2, position", "radius_m: -0.2, position", "obstacles[0].radius_m")):
        text = replaced(NAVIGATION, old, new)
        expect_bad_scenario(context, new.strip(), text, says)
    two = replaced(NAVIGATION, "goals: [[0.4, 0, 0]]", "goals: [[0.4, 0, 0]]\n    random_goals: 2")
    expect_bad_scenario(context, "two kinds of goals", two, ["robots[0]", "one of"])
    none = replaced(NAVIGATION, "    goals: [[0.4, 0, 0]]\n", "") + "duration_s: 1\n"
    expect_complaint(context, "no goals", ["run", context.write("bad.yaml", none), "--out",
                                          stranger(context)], "waypoints or goals")


@case
def goals_that_cannot_be_reached(context):
    """Each goal is rejected with a reason, and the robot continues with the next."""
    write_hall(context)
    goals = {"off the map": (9, 0), "on an obstacle": (1.9, 1.5), "to an obstacle": (-3.8, 0),
             "no path there": (3, 1.5)}
    text = replaced(NAVIGATION, "[[0.4, 0, 0]]",
                    str([[x, y, 0] for x, y in goals.values()] + [[0.4, 0, 0]]))
    context.write("far.yaml", text)
    result = context.run_well("run", "far.yaml", "--out", "out")
    navigation = read_json(context.folder / "out/summary.json")["navigation"]
    check_equal((navigation["goals"], navigation["goals_reached"]), (5, 1), "goals")
    check_equal([goal["goal"][:2] for goal in navigation["goals_unreached"]],
                [list(place) for place in goals.values()], "the goals not reached")
    for reason, goal in zip(goals, navigation["goals_unreached"]):
        check_in(reason, goal["reason"], "the reason")
        check_in(goal["reason"], result.out, "the table")
        check_equal(goal["seed"], 1, "seed")
    page = (context.folder / "out/report.html").read_text(encoding="utf-8")
    check_in("no path there", page, "the page")


# --- Reads, poses and heights ---------------------------------------------------------------------

@case
def malformed_reads_poses_and_heights(context):
    good = {"reads.csv": READS, "poses.csv": POSES, "heights.csv": HEIGHTS}
    table = (
        ("reads.csv", "tag,freq", "tg,freq", "tag", 1),
        ("reads.csv", "phase_rad", "phase", "phase_rad", 1),
        ("reads.csv", "0.1,r,a,one,", "0.1,r,a,one,7,", "fields", 3),
        ("reads.csv", "1.1,-50", "1.1", "fields", 3),
        ("reads.csv", "1.1,", "one,", "expected a finite number", 3),
        ("reads.csv", "1.1,", "nan,", "expected a finite number", 3),
        ("reads.csv", "1.1,", "inf,", "expected a finite number", 3),
        ("reads.csv", "1.1,", ",", "phase_rad", 3),
        ("reads.csv", "1.1,", "1.1rad,", "expected a finite number", 3),
        ("reads.csv", "1.1,", '"1.1,', "", None),
        ("reads.csv", "0.1,r", "soon,r", "stamp_s", 3),
        ("reads.csv", "0.1,r", "nan,r", "stamp_s", 3),
        ("reads.csv", "0.1,r", "1e300,r", "stamp_s", 3),
        ("reads.csv", "0.1,r,a,one", "0.1,r,,one", "antenna is empty", 3),
        ("reads.csv", "0.1,r,a,one", "0.1,r,a,", "tag is empty", 3),
        ("reads.csv", "0.1,r,a,one,865700000", "0.1,r,a,one,-1", "frequency_hz", 3),
        ("reads.csv", "0.1,r,a,one,865700000", "0.1,r,a,one,0", "frequency_hz", 3),
        ("reads.csv", "0.1,r,a,one,865700000,1.1,-50", "0.1,r,a,one,865700000,1.1,loud",
         "rssi_dbm", 3),
        ("poses.csv", "x_m", "x", "x_m", 1),
        ("poses.csv", "0.1,a,0.1", "0.1,a,far", "x_m", 3),
        ("poses.csv", "0.1,a,0.1", "0.1,a,nan", "x_m", 3),
        ("poses.csv", "0.1,a,0.1", "0.1,a,1e15", "x_m is 1e+15 m, expected a position within", 3),
        ("poses.csv", "0.1,a,0.1", "0.1,a,-1000001", "x_m", 3),
        ("heights.csv", "1.0", "1e15", "height_m", 2),
        ("poses.csv", "0.1,a,0.1,0,1,0,0,0,1", "0.1,a,0.1,0,1,0,0,0,0", "length", 3),
        ("poses.csv", "0.1,a,0.1,0,1,0,0,0,1", "0.1,a,0.1,0,1,0,0,0,5", "length", 3),
        ("poses.csv", "0.1,a,0.1,0,1,0,0,0,1", "0.1,a,0.1,0,1,0,0,0", "fields", 3),
        ("poses.csv", "0.1,a,0.1", "0.1,,0.1", "antenna is empty", 3),
        ("heights.csv", "height_m", "height", "height_m", 1),
        ("heights.csv", "1.0", "high", "height_m", 2),
        ("heights.csv", "1.0", "nan", "height_m", 2),
        ("heights.csv", "one,1.0\n", "one,1.0\none,2.0\n", "twice", 3),
        ("heights.csv", "one,1.0", "one", "fields", 2),
        ("heights.csv", "one,1.0", ",1.0", "tag is empty", 2))
    command = ["localize", "reads.csv", "--poses", "poses.csv", "--tag-heights", "heights.csv",
               "--out", stranger(context)]
    for name, old, new, says, line in table:
        for other, text in good.items():
            context.write(other, text)
        context.write(name, replaced(good[name], old, new))
        expect_complaint(context, f"{name} with {new!r}", command, says, line, name)
    for name in good:
        for other, text in good.items():
            context.write(other, text)
        for content, says in (("", "is empty"), (b"\x00\x01\x02" * 50, "text"), ("\n\n\n", "empty")):
            context.write(name, content)
            expect_complaint(context, f"{name} of {content[:3]!r}", command, says, file=name)
        (context.folder / name).unlink()
        expect_complaint(context, f"{name} missing", command, "no such file", file=name)
        (context.folder / name).mkdir()
        expect_complaint(context, f"{name} is a folder", command, "is a folder", file=name)
        (context.folder / name).rmdir()


# --- Output folders and reports -------------------------------------------------------------------

@case
def output_folders_that_cannot_be_written(context):
    path = context.write("good.yaml", SCENARIO)
    context.write("reads.csv", READS)
    context.write("poses.csv", POSES)
    context.write("file", "a file")
    for out in ("file", "file/below", "/proc/tagfield", "/dev/null/x"):
        expect_complaint(context, f"run --out {out}", ["run", path, "--out", out], out, file=out)
        expect_complaint(context, f"localize --out {out}",
                         ["localize", "reads.csv", "--poses", "poses.csv", "--out", out], out,
                         file=out)


@case
def files_that_outputs_must_not_replace(context):
    """Not an input in any case, and a file of another kind only with --force."""
    path = context.write("good.yaml", SCENARIO)
    context.write("reads.csv", READS)
    context.write("poses.csv", POSES)
    context.write("tags.csv", "tag,x_m,y_m,z_m\nnear,1,2,1\n")
    notes = context.write("notes.txt", "somebody's notes")
    run = ["run", path, "--no-page", "--out", stranger(context), "--mcap"]
    calibrate = ["calibrate", "reads.csv", "--poses", "poses.csv", "--tags", "tags.csv", "--out"]
    for command in (run, ["events", "reads.csv", "--epcis"], calibrate, ["gazebo", path, "--out"],
                    ["gazebo", path, "--out", "w.world", "--keep-out"],
                    ["completion", "bash", "--out"]):
        name = " ".join(map(str, command))
        expect_complaint(context, f"{name} of another kind", [*command, notes], "or --force to replace it",
                         file=notes)
    for command, file in ((run, path), (["events", "reads.csv", "--epcis"], "reads.csv"),
                          (calibrate, "tags.csv"), (["gazebo", path, "--out"], path)):
        for force in ([], ["--force"]):
            expect_complaint(context, f"{command[0]} {file} {force}", [*command, file, *force],
                             "would replace an input of this command", file=file)
    os.symlink("good.yaml", context.folder / "link.yaml")
    expect_complaint(context, "a link to an input", [*run, "link.yaml", "--force"], "would replace an input")
    for _ in range(2):  # The second time it replaces its own file.
        context.run_well("completion", "bash", "--out", "completion.bash")
        context.run_well("gazebo", path, "--out", "good.world")
        context.run_well("events", "reads.csv", "--epcis", "events.json")
    context.run_well("events", "reads.csv", "--epcis", notes, "--force")
    check("EPCISDocument" in notes.read_text(encoding="utf-8"), "--force does not replace the notes")


@case
def a_read_only_output_folder(context):
    if os.geteuid() == 0:
        raise Skip("root may write everywhere")
    path = context.write("good.yaml", SCENARIO)
    out = context.folder / "locked"
    out.mkdir(mode=0o555)
    try:
        expect_complaint(context, "read-only", ["run", path, "--out", out], "written", file=out)
    finally:
        out.chmod(0o755)


@case
def a_bad_input_makes_no_folder_full(context):
    """If the output folder did not exist before, it is empty afterwards."""
    bad = context.write("bad.yaml", replaced(SCENARIO, "range_m: 7", "range_m: -7"))
    context.write("poses.csv", POSES)
    context.write("reads.csv", READS.replace("1.1,", "x,"))
    for command in (["run", bad], ["localize", "reads.csv", "--poses", "poses.csv"]):
        result = context.run(*command, "--out", "new/out")
        check_equal(result.code, 2, "exit code")
        check(not files_in(context.folder / "new/out"), f"{command[0]} left files in the new folder")
        context.run(*command)
        check(not (context.folder / "runs").exists(), f"{command[0]} left runs/ behind")


@case
def reports_on_broken_folders(context):
    path = context.write("good.yaml", SCENARIO)
    context.run_well("run", path, "--set", "world.path=" + str(context.write("hall.sdf", WORLD)),
                     "--out", "whole")
    expect_complaint(context, "no folder", ["report", "absent"], "absent")
    (context.folder / "hollow").mkdir()
    expect_complaint(context, "empty folder", ["report", "hollow"], "summary.json")
    expect_complaint(context, "a file", ["report", path], "good.yaml")
    summary = (context.folder / "whole/summary.json").read_text(encoding="utf-8")
    poses = (context.folder / "whole/antenna_poses.csv").read_text(encoding="utf-8")
    for name, content, says in (
            ("summary.json", None, "no such file"), ("summary.json", "", ""),
            ("summary.json", summary[:-20], ""), ("summary.json", "[]", ""),
            ("summary.json", "{}", ""), ("summary.json", summary.replace('"tags"', '"tag"'), "tags"),
            ("summary.json", summary.replace('"complete": true', '"complete": 7'), "complete"),
            ("summary.json", summary.replace('"id": "near"', '"id": 7'), "id"),
            ("summary.json", summary.replace('"verdict": "', '"verdict": "x'), "verdict"),
            ("summary.json", bytes(range(256)), ""),
            ("reads.csv", None, "no such file"), ("reads.csv", "", "is empty"),
            ("reads.csv", READS.replace("1.1,", "x,"), "phase_rad"),
            ("antenna_poses.csv", None, "no such file"),
            ("antenna_poses.csv", poses.replace("x_m", "x"), "x_m"),
            ("antenna_poses.csv", poses.replace(",mast,", ",,", 1), "antenna"),
            ("truth/tags.csv", "nothing\n1\n", "stamp_s"),
            ("truth/robot_poses.csv", "nothing\n1\n", "stamp_s"),
            ("top_view.json", "", ""), ("top_view.json", "{}", ""),
            ("top_view.json", '[{"name": "a"}]', ""),
            ("top_view.json", '[{"name": "a", "z_min": 0, "z_max": 1, "rings": [[[0, "x"]]]}]', "")):
        folder = context.folder / "broken"
        shutil.copytree(context.folder / "whole", folder)
        (folder / name).unlink()
        if isinstance(content, bytes):
            (folder / name).write_bytes(content)
        elif content is not None:
            (folder / name).write_text(content, encoding="utf-8")
        what = "missing" if content is None else repr(content[:20])
        expect_complaint(context, f"report, {name} {what}", ["report", "broken"], says, file=name)
        shutil.rmtree(folder)


# --- Warnings -------------------------------------------------------------------------------------

def warnings_of(result):
    for line in result.err.splitlines():
        check(line.startswith("tagfield: warning: "), f"no warning: {line!r}")
    return result.err


@case
def odd_worlds_get_warnings(context):
    world = context.aws_world()
    result = context.run_well("check", world)
    check_equal(result.err, "", "the warnings of the AWS world")
    check_in("collisions: 25", result.out, "check's words on the AWS world")
    for name, text, says, line in (
            ("no version", WORLD.replace(' version="1.6"', ""), "without a version", None),
            ("a pose in an unknown frame",
             WORLD.replace("<static>",
                           '<pose relative_to="nowhere">0 0 0 0 0 0</pose><static>'), "nowhere", 5),
            ("a box of negative size", WORLD.replace("1 1 1</size>", "1 -1 1</size>"),
             "has no volume", 7),
            ("a cylinder without radius", MODEL.replace(
                "GEOMETRY", "<cylinder><length>1</length></cylinder>"), "1 m is assumed", 7)):
        context.write("hall.sdf", text)
        said = warnings_of(context.run_well("check", "hall.sdf"))
        check_in(says, said, name)
        check_in("hall.sdf:" if line is None else f"hall.sdf:{line}: ", said, name)


@case
def worlds_with_parts_missing_can_be_used_without_them(context):
    context.write("hall.sdf", WORLD.replace(
        "<model", "<include><uri>model://gone</uri></include><model", 1))
    expect_complaint(context, "a model is gone", ["check", "hall.sdf"],
                     "can't find 'model://gone'", 4, "hall.sdf")
    result = context.run_well("check", "hall.sdf", "--skip-missing")
    check_in("can't find 'model://gone': left out", warnings_of(result), "the warnings")
    check_in("collisions: 1", result.out, "what is left")
    context.write("in_hall.yaml",
                  replaced(SCENARIO, "robots:", "world: {path: hall.sdf}\nrobots:"))
    for way in (["--skip-missing"], ["--set", "world.skip_missing=true"]):
        result = context.run_well("run", "in_hall.yaml", "--no-page", "--out", "out", *way)
        check_in("can't find 'model://gone': left out", warnings_of(result), f"run {way}")


@case
def reads_without_poses_get_a_warning(context):
    context.write("reads.csv", READS.replace("0.1,r,a,", "0.1,r,other,"))
    context.write("poses.csv", POSES)
    result = context.run_well("localize", "reads.csv", "--poses", "poses.csv", "--out", "out")
    check_in("'other': 1 of 1 reads have no pose", warnings_of(result), "the warnings")
    summary = read_json(context.folder / "out/summary.json")
    check(any("'other'" in warning for warning in summary["warnings"]), "summary has no warning")
    page = (context.folder / "out/report.html").read_text(encoding="utf-8")
    check_in("have no pose at their stamp", page, "the page")


def expect_nothing_located(context, reads, poses, tags, warning):
    context.write("reads.csv", reads)
    context.write("poses.csv", poses)
    result = context.run_well("localize", "reads.csv", "--poses", "poses.csv", "--out", "out")
    check_in(warning, warnings_of(result), "the warnings")
    rows = read_csv(context.folder / "out/estimates.csv")
    check_equal([(row["tag"], row["verdict"]) for row in rows],
                [(tag, "not_located") for tag in tags], "estimates")
    check(all(row["reason"] for row in rows), f"a tag without a reason: {rows}")
    check_equal(read_json(context.folder / "out/summary.json")["located"], 0, "located")
    check((context.folder / "out/report.html").stat().st_size > 1000, "no page")
    return result


@case
def hopeless_input_cannot_be_localized(context):
    header = READS.splitlines()[0] + "\n"
    expect_nothing_located(context, header, POSES, [], "cannot localize")
    pose_header = POSES.splitlines()[0] + "\n"
    result = expect_nothing_located(context, READS, pose_header, ["one"], "no pose")
    check_in("cannot localize", result.out, "the table")
    result = expect_nothing_located(context, READS, POSES, ["one"], "")
    check_in("cannot localize", result.out, "the table")
    expect_nothing_located(context, header, pose_header, [], "cannot localize")


@case
def a_tag_never_read_cannot_be_localized(context):
    path = context.write("far.yaml", replaced(SCENARIO, "[1, 2, 1]", "[100, 2, 1]"))
    result = context.run_well("run", path, "--out", "out")
    check_in("cannot localize: never read", result.out, "the table")
    check_equal([tag["verdict"] for tag in read_json(context.folder / "out/summary.json")["tags"]
                 if tag["id"] == "near"], ["not_located"], "verdict")


@case
def output_that_cannot_be_printed(context):
    """A full device is reported, and files are not written to the descriptor of a closed stdout."""
    path = context.write("good.yaml", SCENARIO)
    for words in (["check", path], ["check", path, "--json"], ["--version"]):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([context.tagfield, *words], stdout=full, stderr=subprocess.PIPE,
                                  text=True, check=False)
        check_equal(done.returncode, 2, f"exit code of {words[0]} into a full device")
        check_in("the standard output can't be written: No space", done.stderr, "complaint")
    # A server whose address nobody can read must not go on.
    for words in (["serve", path, "--http", "0"], ["serve", path, "--http", "0", "--json"]):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([context.tagfield, *words], stdout=full, stderr=subprocess.PIPE,
                                  text=True, check=False, timeout=60)
        check_equal(done.returncode, 2, f"exit code of {words} into a full device")
        check_in("the standard output can't be written: No space", done.stderr, "complaint")
    context.run_well("run", path, "--no-page", "--out", "open")
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run([context.tagfield, "view", "open", "--http", "0"], cwd=context.folder, stdout=full,
                              stderr=subprocess.PIPE, text=True, check=False, timeout=60)
    check_equal(done.returncode, 2, "exit code of view into a full device")
    closed = f'"{context.tagfield}" run "{path}" --no-page --out closed >&- 2>&-'
    done = subprocess.run(["sh", "-c", closed], cwd=context.folder, check=False)
    check_equal(done.returncode, 0, "exit code with a closed output")
    opened = files_in(context.folder / "open")
    for name, content in files_in(context.folder / "closed").items():
        check(name == "summary.json" or content == opened[name], f"{name} differs")


@case
def what_never_ends(context):
    """Endless files, endless nesting, runs of years."""
    context.run_well("run", context.write("good.yaml", SCENARIO), "--set", "duration_s=0.3",
                     "--no-page", "--out", "out")
    endless = {"one line": "head -c 300000000 /dev/zero | tr '\\0' x", "YAML": "yes 'a: 1'",
               "zeros": "cat /dev/zero"}
    for name, command in endless.items():
        for reader in ("check /dev/fd/3 --set seed=1", "localize /dev/fd/3 --poses out/antenna_poses.csv"):
            if name == "YAML" and reader.startswith("localize"):
                continue
            words = f'"{context.tagfield}" {reader} 3< <({command})'
            done = subprocess.run(["bash", "-c", words], cwd=context.folder, timeout=60,
                                  capture_output=True, text=True, check=False)
            check_equal((done.returncode, len(done.stderr.splitlines())), (2, 1),
                        f"{reader} of {name}, {done.stderr[:300]}")
    # The scene is read for the page's view, which is left out where it could not be bundled.
    has_view = json.loads(context.run_well("--version", "--json").out)["parts"]["page"]
    for file in ("summary.json", "top_view.json", *(["scene.json"] if has_view else [])):
        folder = context.folder / "deep"
        shutil.copytree(context.folder / "out", folder)
        (folder / file).write_text("[" * 500_000 + "]" * 500_000, encoding="utf-8")
        result = context.run("report", folder, timeout=60)
        check_equal((result.code, len(result.err.splitlines())), (2, 1), f"{file}: {result.err[:200]}")
        shutil.rmtree(folder)
    context.write("long.yaml", SCENARIO)
    for settings, code, says in (
            (("duration_s=4e9", "time_step_s=1e-5"), 2, "more than a computer gets done in a year"),
            (("duration_s=4e8",), 0, "this takes hours"),
            (("duration_s=4e8",), 0, "with 'run --record-only' memory doesn't grow")):
        words = [word for setting in settings for word in ("--set", setting)]
        result = context.run("check", "long.yaml", *words)
        check_equal(result.code, code, f"exit code with {settings}")
        check_in(says, result.err, f"what is said with {settings}")


@case
def files_larger_than_allowed(context):
    # Without a key that has no effect with noisy poses and would cause a warning.
    path = context.write("good.yaml", SCENARIO.replace("  wheel_noise: 0.01\n", ""))
    words = f'ulimit -f 4; "{context.tagfield}" run "{path}" --out o'
    done = subprocess.run(["bash", "-c", words], cwd=context.folder, capture_output=True, text=True,
                          check=False)
    check_equal((done.returncode, len(done.stderr.splitlines())), (2, 1), f"exit code ({done.stderr})")
    check_in("can't be written: File too large", done.stderr, "complaint")
    results = [name for name in files_in(context.folder / "o") if not name.startswith("incomplete-")]
    check_equal(results, [], "results")


@case
def more_than_there_is_memory_for(context):
    """A low memory limit simulates a table that is larger than the machine's memory."""
    if "TAGFIELD_SANITIZED" in os.environ:
        raise Skip("a sanitizer needs more memory for itself")
    rows = "".join(f"{0.01 * i:.2f},r,a,one,865700000,1.0,-50\n" for i in range(300_000))
    context.write("reads.csv", READS.splitlines()[0] + "\n" + rows)
    context.write("poses.csv", POSES)
    words = f'ulimit -d 45000; "{context.tagfield}" localize reads.csv --poses poses.csv --out o'
    done = subprocess.run(["bash", "-c", words], cwd=context.folder, capture_output=True, text=True,
                          check=False)
    check_equal(done.returncode, 2, f"exit code ({done.stderr[:300]})")
    check_in("there is memory for", done.stderr, "complaint")


@case
def yaml_beyond_all_measure(context):
    many = context.write("many.yaml", "".join(f"k{i}: 1\n" for i in range(100_001)))
    expect_complaint(context, "keys", ["run", many, "--out", "o"], "has 100001 keys, expected at most")
    path = context.write("good.yaml", SCENARIO)
    expect_complaint(context, "a node that holds itself",
                     ["run", path, "--set", "tags=&a [*a]", "--out", "o"], "--set tags: contains itself")
    long = context.write("long.yaml", "#" * 16_000_001)
    expect_complaint(context, "16 MB", ["run", long, "--out", "o"], "is longer than 16000000 bytes")
    expect_complaint(context, "a device", ["run", "/dev/zero", "--out", "o"], "/dev/zero: ")


if __name__ == "__main__":
    main()
