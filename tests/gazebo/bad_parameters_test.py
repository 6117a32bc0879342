#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Invalid parameters in SDF: one clear error, that sensor is disabled, everything else works."""

import re

from gazebo import (
    Run, antenna, antenna_sensor, case, check, check_between, check_equal, check_in, main, messages, model,
    schedule, tag, tag_sensor, world)

# Content of the antenna's plugin, and the expected error.
BAD_ANTENNAS = {
    "text": ("<frequency>fast</frequency>", "<frequency> is 'fast', expected a number"),
    "nan": ("<noisephi>nan</noisephi>", "<noisephi> is 'nan', expected a number"),
    "infinite": ("<range>1e999</range>", "<range> is '1e999', expected a number"),
    "negative": ("<range>-3</range>", "<range> must be a finite number greater than 0, is -3"),
    "zero": ("<frequency>0</frequency>", "<frequency> must be"),
    "noise": ("<noiserssi>-1</noiserssi>", "<noiserssi> must be"),
    "gain": ("<communication_gain>0</communication_gain>", "<communication_gain> must be"),
    "distribution": ("<optional_distribution>normal</optional_distribution>",
                     "did you mean 'normal_distribution'"),
    "parameters": ("<optional_distribution>uniform_real_distribution</optional_distribution>"
                   "<optional_distribution_params>2 1</optional_distribution_params>",
                   "a must be less than b"),
    "words": ("<optional_distribution>normal_distribution</optional_distribution>"
              "<optional_distribution_params>0 x</optional_distribution_params>",
              "<optional_distribution_params> is 'x', expected a number"),
    "seed": ("<seed>-1</seed>", "<seed> is '-1'"),
    "model": ("<model>magic</model>",
              "<model> is 'magic', expected paper, link_budget, multipath"),
    "power": ("<model>link_budget</model><transmit_power_dbm>loud</transmit_power_dbm>",
              "<transmit_power_dbm> is 'loud', expected a finite number"),
    "order": ("<model>multipath</model><reflection_order>7</reflection_order>",
              "<reflection_order> must be"),
    "carrier": ("<model>multipath</model><channel_plan>etsi</channel_plan>",
                "<channel_plan> there is no"),
    "effect": ("<model>multipath</model><without>noises</without>", "did you mean 'noise'"),
    "parent": ("<parent_frame>nowhere</parent_frame>",
               "<parent_frame> is 'nowhere', expected a link of model 'bad_parent'"),
    "name": ("<antenna>gate</antenna>", "there is an antenna called 'gate' already"),
}
# Complete sensors, and the expected error.
BAD_SENSORS = {
    "wrong_kind": (antenna_sensor("s").replace('type="rfid"', 'type="rfidtag"'),
                   "sensor type is 'rfidtag', expected 'rfid' for an antenna"),
    "wrong_tag": (tag_sensor("s").replace('type="rfidtag"', 'type="rfid"'),
                  "sensor type is 'rfid', expected 'rfidtag' for a tag"),
    "no_epc": (tag_sensor("s", "<epc></epc>"), "<epc> is empty"),
    "same_epc": (tag_sensor("s", "<epc>good_tag</epc>"),
                 "there is a tag with the ID 'good_tag' already"),
    "rate": (antenna_sensor("s", rate=-5), "<update_rate> must be"),
    "tag_kind": (tag_sensor("s", "<sensitivity_dbm>weak</sensitivity_dbm>"),
                 "<sensitivity_dbm> is 'weak', expected a finite number"),
}
BAD_SETS = {
    "no_epc": ("<tag>1 2 3</tag>", '<tag> 1 has no epc'),
    "two_numbers": ('<tag epc="A">1 2</tag>', '<tag epc="A"> has 2 numbers, expected x y z'),
    "kind": ('<tag epc="A">1 2 3</tag><detuning_db>-1</detuning_db>', "<detuning_db> must be"),
    "nan": ('<tag epc="A">1 2 nan</tag>', "'nan', expected a number"),
    "twice": ('<tag epc="A">1 2 3</tag><tag epc="A">1 2 4</tag>', "ID 'A' already"),
    "link": ('<link>roof</link><tag epc="A">1 2 3</tag>', "<link> is 'roof'"),
    "table": ("<table>file:///nowhere.csv</table>", "nowhere.csv"),
}


def check_all_in(parts, text):
    for part in parts:
        check(part in text, f"the log lacks {part!r}")


def errors(text):
    """Gazebo's error lines, without colour codes."""
    plain = re.sub(r"\x1b\[[0-9;]*m", "", text)
    return [line for line in plain.split("\n") if "[Err]" in line]


@case
def each_bad_parameter_is_one_error_and_everything_else_goes_on(context):
    bad = [model(f"bad_{name}", "0 0 1 0 0 0", antenna_sensor(f"bad_{name}", text))
           for name, (text, _) in BAD_ANTENNAS.items()]
    bad += [model(f"bad_{name}", "0 0 1 0 0 0", text) for name, (text, _) in BAD_SENSORS.items()]
    bad += [f'<model name="set_{name}"><static>1</static><link name="link"/>'
            f'<plugin name="set" filename="libTagfieldTagSetPlugin.so">{text}</plugin></model>'
            for name, (text, _) in BAD_SETS.items()]
    log = context.folder / "schedule.log"
    materials = ('<plugin name="materials" filename="libTagfieldMaterialsPlugin.so">'
                 '<made_of name="rack">unobtainium</made_of></plugin>')
    text = world(materials, antenna("gate", 0, 0, 2), tag("good_tag", 1, 0, 1), *bad,
                 schedule(log, stop=1.0))
    with Run(context, text, record=True) as running:
        running.finish(log)
        check(running.is_alive(), "Gazebo has ended")
        said = errors(running.log())
        found = messages(running.bag, "/rfid/reads")
    for name, (_, expected) in {**BAD_ANTENNAS, **BAD_SENSORS}.items():
        sensor = f"bad_{name}" if name in BAD_ANTENNAS else "s"
        place = f"model 'bad_{name}', link 'link', sensor '{sensor}': "
        about = [line for line in said if place in line]
        check_equal(len(about), 1, f"errors about {name}")
        for line in about:
            check_in(expected, line, f"the error about {name}")
    about = [line for line in said if "plugin 'materials': " in line]
    check_equal(len(about), 1, "errors about the materials")
    check_in('<made_of name="rack">: ', about[0], "the error about the materials")
    for name, (_, expected) in BAD_SETS.items():
        about = [line for line in said if f"model 'set_{name}', plugin 'set': " in line]
        check_equal(len(about), 1, f"errors about the set {name}")
        for line in about:
            check_in(expected, line, f"the error about the set {name}")
    check_equal({message.antenna for message in found}, {"gate"}, "antennas that read")
    check_equal({read.epc for message in found for read in message.reads}, {"good_tag"}, "tags")
    check_between(len(found), 15, 16, "updates")


@case
def odd_but_usable_parameters_are_warned_of(context):
    log = context.folder / "schedule.log"
    text = world(antenna("gate", 0, 0, 2, "<range>7</range><freqency>1e9</freqency>"),
                 tag("one", 1, 0, 1, "<color>red</color>"), schedule(log, stop=0.5))
    with Run(context, text, record=True) as running:
        running.finish(log)
        plain = re.sub(r"\x1b\[[0-9;]*m", "", running.log())
        found = messages(running.bag, "/rfid/reads")
    check_all_in(("<freqency> is not known and left out", "did you mean 'frequency'",
                  "<color> is not known", "uses the defaults of: <frequency>"), plain)
    check_equal({read.epc for message in found for read in message.reads}, {"one"}, "tags read")


if __name__ == "__main__":
    main()
