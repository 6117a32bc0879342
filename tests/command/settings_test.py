#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""No setting is ignored silently: each key of the physical models (docs/radio_settings.md) is combined
with several others, and either the reads change, or the command rejects it or warns."""

import hashlib
import itertools
import re

from common import case, check, check_equal, files_in, main

# Two antennas on one reader, a third on another, tags in various orientations, near walls and racks.
HALL = """\
name: hall
duration_s: 4
world: {{path: {world}}}
robots:
  - {{name: r, start: [-1.4, -1.5, -1.5708], speed_m_s: 0.5, waypoints: [[-1.4, -5.2]]}}
antennas:
  - {{name: left, reader: one, on: r, pose: [0, 0.1, 1.5, 0, 0, 1.5708]}}
  - {{name: right, reader: one, on: r, pose: [0, -0.1, 1.5, 0, 0, -1.5708]}}
  - {{name: far, reader: two, pose: [1, -5, 1.5], rate_hz: 10}}
tags:
  - {{id: t1, position: [4.58, -6.4, 1.25]}}
  - {{id: t2, position: [4.58, -3.6, 1.75], rpy: [0.3, 0.2, 0.5]}}
  - {{id: t3, position: [-4.58, -6.6, 1.75]}}
  - {{id: t4, position: [4.58, -4.8, 1.25], rpy: [0.2, 0.1, 3]}}
  - {{id: t5, position: [4.58, -4.83, 1.25]}}
  - {{id: t6, position: [-2.2, -3.5, 1.5], rpy: [0, 0, 3]}}
{row}localization: none
"""

TABLE = "[0,6,6,30,5,4,60,1,0,90,-6,-8,180,-12,-12]"
OTHER_TABLE = "[0,7,7,30,5,4,60,0,-1,90,-7,-9,180,-14,-14]"

# Without quantization, so that small effects show, too.
FINE = ("antennas.*.rssi_step_db=0", "antennas.*.phase_steps=0")

# Combinations with other settings; each is needed for the effect of some keys.
BESIDE = {
    "link budget": ("model=link_budget",),
    "multipath": ("model=multipath", "antennas.*.reflection_order=1"),
    "inventory": ("model=link_budget", "antennas.*.inventory=gen2", "antennas.*.channel_plan=fcc",
                  "antennas.*.transmit_power_dbm=28", "antennas.*.start_q=1", *FINE),
    "fixed Q": ("model=link_budget", "antennas.*.inventory=gen2", "antennas.*.adaptive_q=false",
                "antennas.*.start_q=1", "antennas.*.blf_khz=115", *FINE),
    "isotropic": ("model=link_budget", "antennas.*.pattern=isotropic", "tags.*.pattern=isotropic"),
    "dipoles": ("model=link_budget", "antennas.*.pattern=dipole", "antennas.*.gain_dbi=2.15"),
    "table": ("model=link_budget", "antennas.*.pattern=table", f"antennas.*.pattern_table={TABLE}"),
    "patch tags": ("model=link_budget", "tags.*.pattern=patch", "tags.*.beam_width_deg=100",
                   "tags.*.gain_dbi=4", *FINE),
    "two readers": ("model=link_budget", "antennas.far.interference=on", "antennas.far.frequency_hz=866.3e6", *FINE),
    "in turn": ("model=link_budget", "antennas.*.inventory=gen2", "antennas.right.reader=three",
                "antennas.far.sharing=time", *FINE),
    "linear": ("model=link_budget", "antennas.*.polarization=linear"),
    "hopping": ("model=link_budget", "antennas.*.channel_plan=fcc", "antennas.right.reader=three", *FINE),
}

# Keys tried in a combination that is needed for these alone.
ONLY = {"in turn": {"sharing"}, "hopping": {"channel_plan", "dwell_s"}}

# A non-default value for each key; keys that need others include them.
OF_ANTENNA = {
    "transmit_power_dbm": "24", "cable_loss_db": "2", "receive_pose": "[0,0.3,0,0,0,0]",
    "reflection_order": "2", "diffraction": "on", "tag_coupling": "on", "interference": "on",
    "spectrum_mask": "multiple", "diffuse_k_db": "6", "without": "[noise]", "pattern": "dipole",
    "gain_dbi": "3", "beam_width_deg": "60", "vertical_beam_width_deg": "50", "front_to_back_db": "10",
    "pattern_table": OTHER_TABLE, "polarization": "left_circular", "tilt_deg": "40", "frequency_hz": "915.2e6",
    "channel_plan": "etsi_low", "carriers_hz": "[915.25e6]", "dwell_s": "0.1", "phase_offset_rad": "1",
    "sensitivity_dbm": "-55", "noise_figure_db": "40", "bandwidth_hz": "1e6", "averaged_bits": "8",
    "phase_floor_rad": "0.3", "phase_steps": "64", "rssi_step_db": "3", "doppler_step_hz": "5",
    "reply_s": "0.01", "inventory": "gen2", "session": "s2", "target": "b", "adaptive_q": "false",
    "start_q": "3", "min_q": "1", "max_q": "1", "q_step": "0.45", "capture_db": "0.1", "power_up_s": "0.05",
    "round_overhead_s": "0.05", "slot_overhead_s": "0.01", "read_overhead_s": "0.02",
    "port_dwell_s": "0.05", "sharing": "time", "tari_us": "12.5", "data1_tari": "2", "blf_khz": "280",
    "divide_ratio": "8", "encoding": "miller8", "pilot": "false", "epc_bits": "496",
}
OF_TAG = {
    "pattern": "isotropic", "gain_dbi": "1", "beam_width_deg": "90", "vertical_beam_width_deg": "80",
    "front_to_back_db": "10", "pattern_table": TABLE, "polarization": "right_circular", "tilt_deg": "40",
    "sensitivity_dbm": "-5", "modulation_db": "-12", "detuning_db": "6",
}

# Settings that equal those of the combination, and so change nothing.
AS_BEFORE = {
    ("dipoles", "pattern", "dipole"), ("inventory", "inventory", "gen2"), ("fixed Q", "inventory", "gen2"),
    ("fixed Q", "adaptive_q", "false"), ("isotropic", "pattern", "isotropic"),
}


def keys_of(context, heading):
    """Keys in the table below this heading of the documentation."""
    page = (context.source / "docs" / "radio_settings.md").read_text()
    table = page[page.index(heading):].split("\n\n")[1]
    return re.findall(r"^\| `(\w+)` \|", table, re.M)


@case
def each_key_of_the_docs_has_a_value_here(context):
    check_equal(sorted(keys_of(context, "**An antenna's**")), sorted(OF_ANTENNA), "of antennas")
    check_equal(sorted(keys_of(context, "**A tag's**")), sorted(OF_TAG), "of tags")


@case
def no_setting_is_without_effect_in_silence(context):
    hall = context.write("hall.yaml", HALL.format(
        world=context.source / "worlds" / "small_warehouse.sdf",
        row="".join(f"  - {{id: r{i}, position: [4.58, {-5.2 + 0.3 * i}, 1.6]}}\n" for i in range(8))))
    number = itertools.count()

    def outcome(settings):
        """A digest of the reads, and all messages; no digest if the setting was rejected."""
        out = context.folder / str(next(number))
        sets = [word for setting in settings for word in ("--set", setting)]
        run = context.run("run", hall, "--record-only", "--out", out, *sets)
        check(run.code in (0, 2), f"{settings}: exit code {run.code}, {run.err}")
        if run.code == 2:
            check_equal(run.err.count("tagfield: ") - run.err.count("warning: "), 1, f"lines of the error: {run.err}")
            return None, run.err
        digest = hashlib.sha256()
        for name in sorted(files_in(out)):
            if str(name).endswith(".csv"):
                digest.update((out / name).read_bytes())
        return digest.hexdigest(), run.err

    silent, effective = [], set()
    for name, beside in BESIDE.items():
        usual, said = outcome(beside)
        check(usual is not None, f"{name} is refused: {said}")
        for of, values in (("antennas.left", OF_ANTENNA), ("tags.*", OF_TAG)):
            for key, value in values.items():
                if (name, key, value) in AS_BEFORE or key not in ONLY.get(name, {key}):
                    continue
                read, warnings = outcome((*beside, f"{of}.{key}={value}"))
                if read is not None and read != usual:
                    effective.add((of, key))
                elif read is not None and not set(warnings.splitlines()) - set(said.splitlines()):
                    silent.append(f"{name}: {of}.{key}={value}")
    check_equal(silent, [], "settings that changed nothing, without a word")
    # A key that is always rejected or warned about would be useless.
    never = {(of, key) for of, values in (("antennas.left", OF_ANTENNA), ("tags.*", OF_TAG)) for key in values}
    # (No tag has a pattern table here.)
    check_equal(never - effective, {("tags.*", "pattern_table")}, "settings that never had an effect")


if __name__ == "__main__":
    main()
