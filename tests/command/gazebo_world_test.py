#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""tagfield gazebo writes worlds that tagfield check reads back as the scenario."""

import json

from common import case, check, check_equal, check_in, main


def described(context, path, *arguments):
    return json.loads(context.run_well("check", path, "--json", *arguments).out)


def places(bodies, key):
    return {body[key]: body["position_m"] for body in bodies if body["on"] == "world"}


@case
def worlds_hold_the_scenario(context):
    for name in ("paper_warehouse", "two_antennas", "spawn"):
        world = context.folder / f"{name}.world"
        result = context.run_well("gazebo", context.shipped(name), "--out", world)
        check_in(f"world: {world}\n", result.out, "the output")
        check_in("GAZEBO_MODEL_PATH=", result.out, "the output")
        scenario = described(context, context.shipped(name))
        read = described(context, world)
        check_equal(places(read["tags"], "id"), places(scenario["tags"], "id"), f"{name}: tags")
        check_equal({antenna["name"] for antenna in read["antennas"]},
                    {antenna["name"] for antenna in scenario["antennas"]}, f"{name}: antennas")
        collisions = {collision["name"] for collision in read["collisions"]}
        for collision in scenario["collisions"]:
            check(collision["name"] in collisions, f"{name}: {collision['name']} is missing")


@case
def the_world_is_named_after_the_scenario(context):
    context.run_well("gazebo", context.shipped("paper_warehouse"), "--set", "seed=42")
    text = (context.folder / "paper_warehouse.world").read_text(encoding="utf-8")
    check_in("<seed>42</seed>", text, "the world")


@case
def bad_requests_are_reported(context):
    scenario = context.shipped("paper_warehouse")
    for arguments, says in (
            (("--out", context.folder / "no/such/folder/x.world"), "x.world"),
            (("--out", context.folder), str(context.folder)),
            (("--real-time", "-1"), "--speed: '-1': expected a multiple of real time"),
            (("--speed", "fast"), "--speed: 'fast': expected a multiple of real time"),
            (("--set", "tags.tag1.id=tag2"), "tag2"), (("--set", "robots.p3at.name=other"), "p3at")):
        result = context.run("gazebo", scenario, *arguments)
        check_equal(result.code, 2, f"exit code with {arguments}")
        check_in(says, result.err, "the complaint")
        check_equal(result.err.count("\n"), 1, f"lines of {result.err!r}")


if __name__ == "__main__":
    main()
