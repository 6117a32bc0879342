#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The commands explain and coverage end to end: verdicts, link budgets, agreement with a run, files,
the page, and invalid input."""

import json
import math
import re
import xml.etree.ElementTree as ElementTree

from common import (SPEED_OF_LIGHT, case, check, check_between, check_equal, check_in, check_near,
                    files_in, main, read_csv, read_json)

MULTIPATH = ("--set", "model=multipath")

# An isotropic antenna with 20 dBm and tags with −18 dBm in free space: a path loss of 38 dB is reached at
# λ/4π · 10^(38/20) = 2.19 m.
OPEN = """\
name: open
duration_s: 10
model: link_budget
without: [polarization]
antennas:
  - {name: gate, pose: [0, 0, 1], pattern: isotropic, gain_dbi: 0, transmit_power_dbm: 20}
  - {name: far, pose: [20, 0, 1], pattern: isotropic, gain_dbi: 0, transmit_power_dbm: 20}
tags:
  - {id: near, position: [1, 0, 1], pattern: isotropic, gain_dbi: 0}
  - {id: late, position: [2, 0, 1], pattern: isotropic, gain_dbi: 0, appears_s: 5}
  - {id: lost, position: [10, 3, 1], pattern: isotropic, gain_dbi: 0}
"""


def friis_db(distance):
    return 20.0 * math.log10(SPEED_OF_LIGHT / 865.7e6 / (4.0 * math.pi * distance))


def explained(context, scenario, *arguments):
    def refuse(word):
        raise ValueError(f"{word} in JSON")
    result = context.run_well("explain", scenario, "--json", *arguments)
    return json.loads(result.out, parse_constant=refuse)


# --- explain --------------------------------------------------------------------------------------

@case
def help_teaches(context):
    for command, words in (
            ("explain", ("--antenna", "--tag", "--time", "--json", "--set", "--seed",
                         "not read:", "docs/explain.md", "multipath")),
            ("coverage", ("--antenna", "--tag-profile", "--orientation", "--height", "--step",
                          "--region", "--out", "--time", "coverage.html", "docs/coverage.md"))):
        result = context.run_well(command, "--help")
        for word in words:
            check_in(word, result.out, f"{command} --help")


@case
def the_verdict_comes_first(context):
    path = context.write("open.yaml", OPEN)
    first = {}
    for tag, time in (("near", 0), ("late", 0), ("late", 5), ("lost", 0)):
        out = context.run_well("explain", path, "--antenna", "gate", "--tag", tag, "--time",
                               time).out
        first[tag, time] = out.splitlines()[0]
        check_in("free space over", out, tag)
    margin = 20.0 + friis_db(1.0) + 18.0
    back = 20.0 + 2.0 * friis_db(1.0) - 5.0 + 84.0
    check_equal(first["near", 0], f"read: +{margin:.1f} dB at the tag, +{back:.1f} dB at the reader",
                "verdict of the near one")
    check_equal(first["late", 0], "not read: not there yet (appears at 5 s)", "verdict too early")
    check(first["late", 5].startswith("read: +0.8 dB at the tag"), first["late", 5])
    check(first["lost", 0].startswith("not read: −13.6 dB at the tag"), first["lost", 0])


@case
def the_lines_add_up(context):
    for tag in ("tag1", "tag5", "tag8"):
        link = explained(context, context.shipped("paper_warehouse"), *MULTIPATH, "--tag", tag,
                         "--time", "15")
        check_near(sum(line["db"] for line in link["to_tag"]), link["tag_dbm"], 0.01, tag)
        check_near(sum(line["db"] for line in link["to_reader"]), link["reply_dbm"], 0.01, tag)
        check(len(link["paths"]) > 5, f"{tag}: {len(link['paths'])} paths")
        direct = link["paths"][0]
        check_equal(direct["bounces"], 0, "the first path's bounces")
        check_near(direct["length_m"], link["distance_m"], 1e-9, "the direct way")
        # The sum of all paths as phasors relative to the direct one gives the line of the other paths.
        field = sum(10.0 ** (p["relative_db"] / 20.0) *
                    complex(math.cos(p["relative_phase_rad"]), math.sin(p["relative_phase_rad"]))
                    for p in link["paths"] if p["relative_db"] is not None)
        free = [line["db"] for line in link["to_tag"]
                if line["what"].startswith(("antenna gain", "free space", "polarization",
                                            "tag gain"))]
        total = 30.0 + sum(free) + 20.0 * math.log10(abs(field))
        check_near(total, link["tag_dbm"], 0.05, f"{tag}: the sum of its paths")


@case
def nothing_arrives_at_a_tag_that_is_seen_end_on(context):
    path = context.write("end_on.yaml", """\
model: link_budget
duration_s: 1
antennas: [{name: gate, reader: r, pose: [0, 0, 1.5, 0, 0, 0], channel_plan: etsi_low}]
tags: [{id: lay, position: [0, 0, 4]}]
""")
    out = context.run_well("explain", path).out
    check(out.startswith("not read: nothing at the tag"), out)
    check("remains" not in out, out)
    link = explained(context, path)
    check_equal(link["tag_dbm"], None, "power at the chip")
    check_equal([line["what"] for line in link["to_tag"] if line["db"] is None],
                ["tag gain towards the antenna"], "lines of nothing")
    check(all(line["db"] is None or line["db"] < 40 for line in link["to_tag"]), f"{link['to_tag']}")


@case
def materials_are_given_at_the_carrier(context):
    materials = {}
    for hertz in (865.7e6, 2.4e9):
        link = explained(context, context.shipped("paper_warehouse"), *MULTIPATH, "--tag", "tag1",
                         "--set", f"antennas.mobile.frequency_hz={hertz}",
                         "--set", "world.default_material=medium_dry_ground",
                         "--set", "world.materials={'*': medium_dry_ground}")
        materials[hertz], = link["materials"]
    # P.2040-3: 15·f^−0.1, 0.035·f^1.63, from 1 GHz up.
    for hertz, material in materials.items():
        ghz = hertz / 1e9
        check_near(material["permittivity"], 15.0 * ghz ** -0.1, 1e-9, f"{hertz}")
        check_near(material["conductivity_s_m"], 0.035 * ghz ** 1.63, 1e-9, f"{hertz}")
        check_equal(material["extrapolated"], ghz < 1.0, f"{hertz}")


@case
def waves_bend_where_it_is_asked_for(context):
    wall = context.write("wall.world", """<?xml version="1.0"?><sdf version="1.6"><world name="w"><model name="plate">
<static>1</static><link name="link"><collision name="collision"><geometry><box><size>0.01 2 2</size></box></geometry></collision>
</link></model></world></sdf>""")
    path = context.write("bent.yaml", OPEN.replace("model: link_budget", "model: multipath").replace(
        "pose: [0, 0, 1]", "pose: [-1, 0, 0]").replace("position: [1, 0, 1]", "position: [1, 0, 0]") +
        f"world: {{path: {wall}, materials: {{plate: metal}}}}\n")
    words = ("--antenna", "gate", "--tag", "near")
    dark = explained(context, path, *words)
    check_equal(dark["verdict"], "not read: blocked by plate (metal)", "without")
    for key in ("diffraction", "antennas.gate.diffraction"):
        link = explained(context, path, *words, "--set", f"{key}=on")
        around = [p for p in link["paths"] if p["around"]]
        # The plate's four edges, all at the same distance from both ends: √(1² + 1²) twice.
        check_equal(len(around), 4, key)
        for p in around:
            check_near(p["length_m"], 2.0 * math.sqrt(2.0), 1e-9, key)
            check_equal(p["around"]["object"], "plate", key)
        check_near(sum(line["db"] for line in link["to_tag"]), link["tag_dbm"], 0.01, key)
        field = sum(10.0 ** (p["relative_db"] / 20.0) *
                    complex(math.cos(p["relative_phase_rad"]), math.sin(p["relative_phase_rad"]))
                    for p in around)
        check_near(20.0 + friis_db(2.0) + 20.0 * math.log10(abs(field)), link["tag_dbm"], 0.01, key)
    out = context.run("explain", path, *words, "--set", "diffraction=on", "--set",
                      "without=[polarization, diffraction]")
    check_in("blocked by plate", out.out, "left out")
    out = context.run("explain", path, *words, "--set", "diffraction=maybe")
    check_in("off", out.err, "a bad word")
    check_in("diffraction", out.err, "a bad word")


@case
def people_cross_a_link(context):
    path = context.write("crossed.yaml", """\
name: crossed
duration_s: 8
model: link_budget
without: [polarization, noise, quantization]
antennas:
  - {name: gate, pose: [-2, 0, 1], pattern: isotropic, gain_dbi: 6, frequency_hz: 915e6, rate_hz: 20}
tags:
  - {id: tag, position: [2, 0, 1], pattern: isotropic, gain_dbi: 0}
obstacles:
  - {name: worker, radius_m: 0.2, material: person, trajectory: [[0, 0, -4], [8, 0, 4]]}
""")
    without = explained(context, path, "--set", "without=[polarization, bodies]")["tag_dbm"]
    crossing = explained(context, path, "--time", "4")
    line, = [line["db"] for line in crossing["to_tag"] if line["what"] == "past worker (person)"]
    check_between(line, -6.0, -3.0, "a person in the middle")
    check_near(crossing["tag_dbm"] - without, line, 1e-6, "that alone")
    check_near(explained(context, path, "--time", "1")["tag_dbm"], without, 1.0, "far off")
    out = context.folder / "crossed"
    context.run_well("run", path, "--no-page", "--record-only", "--out", out)
    rssi = {round(float(read["stamp_s"]), 2): float(read["rssi_dbm"])
            for read in read_csv(out / "reads.csv")}
    check_near(rssi[4.0], crossing["reply_dbm"], 0.01, "the run's")
    check(min(rssi.values()) > rssi[4.0] - 6.0, "the middle is among the weakest")
    bad = context.run("run", path, "--set", "obstacles.0.material=persn")
    check_in("did you mean 'person'", bad.err, "a slip")


WALLED = """\
name: walled
duration_s: 5
model: link_budget
antennas:
  - {name: gate, pose: [0, 0, 1]}
obstacles:
  - {name: stack, size: [0.1, 8], position: [1.5, 0], material: metal, height_m: 4}
  - {name: cart, radius_m: 0.3, position: [0.5, 0], material: metal, appears_s: 3}
tags:
  - {id: behind, position: [3, 0, 1]}
  - {id: late, position: [0, 1.5, 1], appears_s: 2}
"""


@case
def what_stands_in_the_way_blocks_in_explain_coverage_and_run(context):
    path = context.write("walled.yaml", WALLED)
    check_in("behind stack (metal)", explained(context, path, "--tag", "behind")["verdict"], "verdict")
    out = context.folder / "coverage"
    result = context.run_well("coverage", path, "--step", "0.5", "--out", out)
    check_in("1 moving body is left out", result.err, "stderr")
    by_tag = {tag["id"]: tag["verdict"] for tag in read_json(out / "coverage.json")["tags"]}
    check_equal(by_tag, {"behind": "never", "late": "intended"}, "verdicts")
    context.run_well("run", path, "--no-page", "--record-only", "--out", context.folder / "run")
    check_equal({read["tag"] for read in read_csv(context.folder / "run/reads.csv")}, {"late"}, "read")
    at_once = context.run_well("coverage", path, "--step", "0.5", "--time", "1", "--out", out)
    check_in("tag 'late' is left out: at 1 s it is not there yet", at_once.err, "stderr")
    check_in("with all as it is at 1 s: 0 of 1 tags read", at_once.out, "stdout")


@case
def tags_belong_where_they_appear(context):
    path = context.write("belt.yaml", """\
name: belt
model: link_budget
duration_s: 10
antennas:
  - {name: a, reader: first, pose: [0, 1, 1, 0, 0, -1.57]}
  - {name: b, reader: second, pose: [20, 1, 1, 0, 0, -1.57]}
zones:
  - {name: start, box: [-2, -2, 2, 2], readers: [first]}
  - {name: end, box: [18, -2, 22, 2], readers: [second]}
tags:
  - {id: parcel, trajectory: [[0, 0, 0, 1], [10, 20, 0, 1]], appears_s: 9}
""")
    context.run_well("coverage", path, "--step", "1", "--out", context.folder / "coverage")
    tag, = read_json(context.folder / "coverage/coverage.json")["tags"]
    check_equal(tag["meant_for"], ["second"], "meant for")
    context.run_well("run", path, "--no-page", "--out", context.folder / "run")
    zones = read_json(context.folder / "run/summary.json")["inventory"]["zones"]
    check_equal([(zone["zone"], zone["tags"]) for zone in zones], [("start", 0), ("end", 1)], "zones")


TWO_READERS = """\
name: two_readers
duration_s: 2
model: link_budget
without: [polarization, noise, quantization]
antennas:
  - {name: gate, reader: one, pose: [0, 0, 1], pattern: isotropic, gain_dbi: 0, frequency_hz: 866.3e6}
  - {name: dock, reader: two, pose: [6, 0, 1], pattern: isotropic, gain_dbi: 0, frequency_hz: FREQUENCY}
tags:
  - {id: near, position: [1, 0, 1], pattern: isotropic, gain_dbi: 0}
  - {id: middle, position: [2.5, 0, 1], pattern: isotropic, gain_dbi: 0}
"""


@case
def readers_disturb_one_another(context):
    def path(frequency, **antenna):
        keys = "".join(f", {key}: {value}" for key, value in antenna.items())
        text = TWO_READERS.replace("FREQUENCY}", f"{frequency}{keys}}}")
        return context.write(f"two_readers_{frequency}.yaml", text)

    words = ("--antenna", "gate", "--tag")
    apart = path("866.9e6")
    check_equal(explained(context, apart, *words, "near")["interference"], None, "off")
    link = explained(context, apart, *words, "near", "--set", "interference=on")
    by, = link["interference"]["by"]
    received = 30.0 + friis_db(6.0)
    check_near(by["received_dbm"], received, 0.01, "Friis")
    # Miller 4's bands, 350 and 850 kHz off, are beyond the third channel: −65 dB in 100 kHz.
    in_replies = received - 65.0 + 10.0 * math.log10(2.5)
    check_near(by["in_replies_dbm"], in_replies, 0.01, "I")
    noise = -173.98 + 10.0 * math.log10(250e3) + 25.0
    total = 10.0 * math.log10(10.0 ** (noise / 10.0) + 10.0 ** (in_replies / 10.0))
    check_near(link["interference"]["sinr_db"], link["reply_dbm"] - total, 0.01, "SINR")
    check_near(link["interference"]["capture_db"], 20.0 * math.log10(5.0), 0.01, "at the chip")
    check(link["read"], link["verdict"])
    middle = explained(context, apart, *words, "middle", "--set", "interference=on")
    check_in("command not decodable at the tag (+2.9 dB over reader two, +6.9 dB needed)", middle["verdict"],
             "in the middle")
    # At an offset of 250 kHz, the other reader's carrier is in the band of the replies.
    drowned = explained(context, path("866.55e6"), *words, "near", "--set", "interference=on")
    check_in("reply not decodable beside reader two (SINR −", drowned["verdict"], "on the replies")
    out = context.run_well("explain", apart, *words, "near", "--set", "interference=on").out
    for row in ("two (dock), carrier +0.600 MHz off", "noise and interference", "(SINR)"):
        check_in(row, out, "text")

    def read(scenario, *settings):
        folder = context.simulate(scenario, "--no-page", "--record-only", *settings)
        return {row["tag"] for row in read_csv(folder / "reads.csv") if row["antenna"] == "gate"}
    check_equal(read(apart), {"near", "middle"}, "without")
    check_equal(read(apart, "--set", "interference=on"), {"near"}, "with")
    check_equal(read(path("866.55e6"), "--set", "interference=on"), set(), "on the replies")
    alone = context.run("explain", apart, *words, "near", "--set", "interference=on", "--set",
                        "antennas.dock.reader=one")
    check_equal(alone.code, 2, "one reader only")
    check_in("interference has no effect: no other reader sends while antenna 'gate' does",
             alone.err, "one reader only")


@case
def tags_nearby_couple(context):
    path = context.write("beside.yaml", """\
name: beside
duration_s: 1
model: link_budget
without: [polarization, noise, quantization, phase_offsets, pi_ambiguity]
antennas:
  - {name: gate, pose: [-2, 0, 1], pattern: isotropic, gain_dbi: 0, frequency_hz: 866e6}
tags:
  - {id: left, position: [0, 0.0865435, 1]}
  - {id: right, position: [0, -0.0865435, 1]}
  - {id: far, position: [0, 2, 1]}
""")
    # λ/2 apart: Z₂₁ = −12.52 − j29.91 Ω (Balanis), 1/(1 + Z₂₁/2R) with chips matched to 73.1 Ω.
    factor = 1.0 / (1.0 + complex(-12.52, -29.91) / (2.0 * 73.08))
    expected = 20.0 * math.log10(abs(factor))
    links = {}
    for coupling in ("off", "on"):
        links[coupling] = explained(context, path, "--tag", "left", "--set",
                                    f"tag_coupling={coupling}")
    link = links["on"]
    line, = [line["db"] for line in link["to_tag"]
             if line["what"] == "coupling with 1 tag nearby"]
    check_near(line, expected, 0.002, "two of them")
    check_near(link["tag_dbm"] - links["off"]["tag_dbm"], expected, 0.002, "to the tag")
    check_near(link["reply_dbm"] - links["off"]["reply_dbm"], 2.0 * expected, 0.004, "and back")
    check_near(sum(line["db"] for line in link["to_tag"]), link["tag_dbm"], 1e-6, "the lines")
    check_near(sum(line["db"] for line in link["to_reader"]), link["reply_dbm"], 1e-6, "the lines")
    near, = link["near_tags"]
    check_equal(near["tag"], "right", "who is near")
    check_near(near["distance_m"], 0.173087, 1e-9, "how near")
    check_near(near["alone_db"], line, 1e-9, "alone")
    check_equal(links["off"]["near_tags"], [], "off")
    out = context.run_well("explain", path, "--tag", "left", "--set", "tag_coupling=on").out
    check_in("right, 0.173 m", out, "text")
    rows = read_csv(context.simulate(path, "--no-page", "--record-only", "--set",
                                     "tag_coupling=on") / "reads.csv")
    by_tag = {row["tag"]: row for row in rows}
    check_near(float(by_tag["left"]["rssi_dbm"]), link["reply_dbm"], 0.01, "the run's RSSI")
    turn = float(by_tag["left"]["phase_rad"]) - link["phase_rad"]
    check_near(math.remainder(turn, 2.0 * math.pi), 0.0, 1e-3, "the run's phase")
    stack = context.write("stack.yaml", path.read_text(encoding="utf-8").split("tags:")[0] + "tags:\n" +
                          "".join(f"  - {{id: t{i}, position: [0, {0.01 * i}, 1]}}\n"
                                  for i in range(11)))
    verdict = explained(context, stack, "--tag", "t5", "--set", "tag_coupling=on")["verdict"]
    check_in("by tags nearby (−20.", verdict, "in a stack")
    lone = explained(context, path, "--tag", "far", "--set", "tag_coupling=on")
    check_equal(lone["near_tags"], [], "far off")


@case
def explains_what_a_run_reads(context):
    """At a read's stamp, the link is explained as read, with the reported RSSI and phase."""
    scenario = context.shipped("paper_warehouse")
    settings = ("--set", "model=link_budget", "--set", "without=[noise,quantization,pi_ambiguity]",
                "--set", "duration_s=20")
    reads = read_csv(context.simulate(scenario, *settings, "--no-page") / "reads.csv")
    check(len(reads) > 100, f"{len(reads)} reads")
    for read in reads[::len(reads) // 5]:
        link = explained(context, scenario, *settings, "--tag", read["tag"], "--time",
                         read["stamp_s"])
        what = f"{read['tag']} at {read['stamp_s']} s"
        check(link["read"], f"{what}: {link['verdict']}")
        check_near(link["reply_dbm"], float(read["rssi_dbm"]), 0.01, f"RSSI of {what}")
        turn = (link["phase_rad"] - float(read["phase_rad"]) + math.pi) % (2.0 * math.pi) - math.pi
        check_near(turn, 0.0, 0.02, f"phase of {what}")


@case
def papers_model_is_explained_by_range(context):
    link = explained(context, context.shipped("paper_warehouse"), "--tag", "tag1")
    check_equal(link["model"], "paper", "model")
    check_equal(link["range_m"], 7.0, "range")
    check_equal(link["read"], link["distance_m"] <= link["perturbed_range_m"], "verdict")
    wavelength = SPEED_OF_LIGHT / 865.7e6
    phase = (4.0 * math.pi * link["distance_m"] / wavelength) % (2.0 * math.pi)
    check_near(link["phase_rad"], phase, 1e-6, "eq. (4)")


# --- coverage -------------------------------------------------------------------------------------

@case
def coverage_is_a_circle_in_the_open(context):
    path = context.write("open.yaml", OPEN)
    out = context.folder / "out"
    arguments = ("coverage", path, "--antenna", "gate", "--region=-4,-4,4,4", "--step", "0.1",
                 "--height", "1", "--out", out)
    said = context.run_well(*arguments).out
    radius = SPEED_OF_LIGHT / 865.7e6 / (4.0 * math.pi) * 10.0 ** (38.0 / 20.0)
    cells = read_csv(out / "coverage_1.00m.csv")
    check_equal(len(cells), 6400, "cells")
    for cell in cells:
        distance = math.hypot(float(cell["x_m"]), float(cell["y_m"]))
        check_equal(float(cell["probability"]), 1.0 if distance <= radius else 0.0,
                    f"probability at {distance} m")
        check_near(float(cell["power_dbm"]), 20.0 + friis_db(distance), 0.006, "power")
    coverage = read_json(out / "coverage.json")
    check_near(coverage["heights"][0]["share_read"], math.pi * radius ** 2 / 64.0, 0.01, "share")
    check_equal(coverage["region_m"], [-4.0, -4.0, 4.0, 4.0], "region")
    check_equal(coverage["tag_counts"],
                {"never": 1, "intended": 2, "also_other": 0, "wrong": 0, "seldom": 0}, "tags")
    check_in("never read: 1 of 3 tags\n  lost", said, "what is said")
    before = files_in(out)
    check("coverage.html" in before and len(before) == 9, f"files are {sorted(before)}")
    context.run_well(*arguments, "--threads", "1")
    check(files_in(out) == before, "files differ with one thread")


@case
def the_page_is_whole_and_alone(context):
    out = context.folder / "out"
    context.run_well("coverage", context.shipped("two_antennas"), *MULTIPATH, "--step", "1",
                     "--height", "1", "--height", "2", "--time", "0", "--out", out)
    page = (out / "coverage.html").read_text(encoding="utf-8")
    for word in ("<script src", "http://", "https://", "nan", "inf<"):
        check(word not in page.replace("Infinity", ""), f"{word} in the page")
    for quantity in ("probability", "margin", "power", "antenna"):
        for height in ("1.00m", "2.00m"):
            name = f"{quantity}_{height}"
            check_in(f'id="{name}"', page, "the page")
            svg = out / f"figures/{name}.svg"
            ElementTree.parse(svg)
            check(re.search(r"\b(nan|inf)\b", svg.read_text(encoding="utf-8")) is None, name)
    check_in("[dBm]", page, "the page")
    # Another coverage in the same folder removes the files of this one.
    context.run_well("coverage", context.shipped("two_antennas"), "--step", "1", "--height", "3",
                     "--antenna", "fixed", "--out", out)
    names = [name for name in files_in(out) if "1.00m" in str(name) or "antenna_" in str(name)]
    check_equal(names, [], "files of before")


@case
def orientations_count(context):
    """A dipole that is upright, that points at the antenna, and in any orientation."""
    text = OPEN.replace("without: [polarization]", "without: [occlusion]")
    path = context.write("open.yaml", text)
    powers = {}
    for orientation in ("0,0,0", "0,1.5707963,0", "any", "worst"):
        out = context.folder / "out"
        context.run_well("coverage", path, "--antenna", "gate", "--region=1.9,-0.1,2.1,0.1",
                         "--step", "0.2", "--height", "1", "--orientation", orientation, "--tag-set",
                         "pattern=dipole", "--tag-set", "gain_dbi=2.15", "--out", out)
        field = read_csv(out / "coverage_1.00m.csv")[0]["power_dbm"]
        powers[orientation] = float(field) if field else -400.0
    check_near(powers["0,0,0"], 20.0 + friis_db(2.0) + 2.15 - 3.01, 0.01,
               "an upright one")
    check(powers["0,1.5707963,0"] < -100.0, "a dipole sends nothing along its wire")
    check(powers["worst"] <= powers["0,1.5707963,0"], "the worst one")
    check_between(powers["any"], powers["0,0,0"] - 10.0, powers["0,0,0"], "the mean")


@case
def coverage_is_of_the_tag_that_is_named(context):
    # Two tag models; the maps of the second are 6 dB stronger at the chip.
    path = context.write("kinds.yaml", OPEN.replace(
        "[10, 3, 1], pattern: isotropic, gain_dbi: 0", "[10, 3, 1], pattern: isotropic, gain_dbi: 6"))
    powers = {}
    for name, words in (("first", ()), ("near", ("--tag", "near")), ("lost", ("--tag", "lost")),
                        ("set", ("--tag", "near", "--tag-set", "gain_dbi=6", "--tag-set", "beam_width_deg=40")),
                        ("old", ("--tag", "gain_dbi=6"))):
        result = context.run_well("coverage", path, "--antenna", "gate", "--region=1.9,-0.1,2.1,0.1",
                                  "--step", "0.2", "--height", "1", *words, "--json", "--out",
                                  context.folder / "out")
        check_equal(json.loads(result.out), read_json(context.folder / "out/coverage.json"), "--json")
        check_equal("is now --tag-set gain_dbi=6" in result.err, name == "old", f"warning of {name}")
        check_equal("--tag-set beam_width_deg has no effect with pattern: isotropic" in result.err, name == "set",
                    f"warning of {name}: {result.err}")
        powers[name] = float(read_csv(context.folder / "out/coverage_1.00m.csv")[0]["power_dbm"])
    check_near(powers["near"], powers["first"], 1e-6, "the first is taken")
    for name in ("lost", "set", "old"):
        check_near(powers[name], powers["near"] + 6.0, 1e-3, name)


@case
def without_an_antenna_it_is_the_one_whose_link_is_best(context):
    path = context.write("open.yaml", OPEN)
    # By Friis' law the nearer one; at (10, 3) both have the same distance, and the first is selected.
    for tag, place, nearer in (("near", (1, 0), "gate"), ("lost", (10, 3), "gate"), ("lost", (11, 3), "far")):
        asked = ("--set", f"tags.{tag}.position=[{place[0]}, {place[1]}, 1]", "--tag", tag)
        best = explained(context, path, *asked)
        check_equal((best["antenna"], best["antennas_compared"]), (nearer, 2), f"antenna for {tag} at {place}")
        named = explained(context, path, *asked, "--antenna", nearer)
        check_equal({**best, "antennas_compared": 1}, named, f"explanation for {tag}")
    text = context.run_well("explain", path, "--tag", "near").out
    check_in("of 2 antennas the one with the best link; --antenna names another", text, "explain")


# --- Bad input ------------------------------------------------------------------------------------

@case
def bad_arguments(context):
    path = context.write("open.yaml", OPEN)
    profile = context.write("reader.yaml", "name: r\nkind: reader\nfigures: {}\n")
    out = context.folder / "out"
    explain = ["explain", path, "--antenna", "gate", "--tag", "near"]
    coverage = ["coverage", path, "--out", out]
    for command, says in (
            (["explain"], "SCENARIO"), (["explain", "absent.yaml"], "no such file"),
            (["explain", path, "--antenna", "gate"], "3 tags; say which with --tag"),
            (["explain", path, "--antenna", "gat", "--tag", "near"], "did you mean 'gate'"),
            (["explain", path, "--antenna", "gate", "--tag", "neer"], "did you mean 'near'"),
            ([*explain, "--time", "11"], "the run ends at 10 s"),
            ([*explain, "--time", "-1"], "time"), ([*explain, "--time", "soon"], "time"),
            ([*explain, "--seed", "-1"], "seed"), ([*explain, "--set", "x"], "key.path=value"),
            ([*coverage, "--antenna", "gte"], "did you mean 'gate'"),
            ([*coverage, "--step", "0"], "step"), ([*coverage, "--step", "nan"], "step"),
            ([*coverage, "--step", "0.001"], "cells"),
            ([*coverage, "--height", "high"], "height"),
            ([*coverage, "--region", "1,2,3"], "3 numbers, expected X_LOW"),
            ([*coverage, "--region", "1,1,0,2"], "X_LOW < X_HIGH"),
            ([*coverage, "--region", "1,1,x,2"], "'x' is not a number"),
            ([*coverage, "--region", "0,0,1e9,2"], "'1e9' is not a number up to 1e6"),
            ([*coverage, "--orientation", "up"], "ROLL,PITCH,YAW"),
            ([*coverage, "--orientation", "0,0"], "2 numbers"),
            ([*coverage, "--tag-set", "sensitivity_dbm"], "key=value"),
            ([*coverage, "--tag-set", "sensitivty_dbm=-20"], "did you mean 'sensitivity_dbm'"),
            ([*coverage, "--tag-set", "sensitivity_dbm=low"], "expected a finite number"),
            ([*coverage, "--tag", "neer"], "did you mean 'near'"),
            ([*coverage, "--tag", "near", "--tag", "late"], "expected one name"),
            ([*coverage, "--tag", "near", "--tag-profile", "monza_r6"], "both state the kind"),
            ([*coverage, "--tag-profile", "absent.yaml"], "absent.yaml"),
            ([*coverage, "--tag-profile", profile], "expected kind: tag"),
            ([*coverage, "--time", "11"], "the run ends at 10 s"),
            ([*coverage, "--threads", "0"], "threads")):
        what = " ".join(map(str, command[2:] or command))
        result = context.run(*command, timeout=60)
        check_equal(result.code, 2, f"exit code of {what} ({result.err.strip()})")
        check_equal(len(result.err.splitlines()), 1, f"lines of {what}: {result.err!r}")
        check_equal(result.out, "", f"output of {what}")
        check_in(says.lower(), result.err.lower(), what)
        check(not (out / "coverage.html").exists(), f"{what} left a page")


if __name__ == "__main__":
    main()
