#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Poses of solids agree with those in the real Gazebo 11."""

import pathlib

from gazebo import Skip, TOP, case, check, check_equal, main, require_gazebo
from world_parity import parity

# Worlds that come with Gazebo.
GAZEBOS = ("nested_model", "heightmap", "polyline")
ROOT = TOP / "build/gazebo-root"

# Poses in other frames, included models that are renamed and moved, one of them twice, and a saved state, which takes
# precedence. The nested model has no relative_to, which Gazebo 11 reports as unsupported there, using the raw pose.
WORLD = """<?xml version="1.0"?>
<sdf version="1.7">
  <world name="default">
    <frame name="dock"><pose>5 -2 0.5 0.1 0.2 1.2</pose></frame>
    <frame name="gate" attached_to="rack"><pose>1 0 0 0 0 0.5</pose></frame>
    <model name="rack">
      <static>true</static>
      <pose relative_to="dock">1 2 3 0 0 0.7</pose>
      <frame name="shelf" attached_to="upper"><pose>0 0 0.1 0 0.3 0</pose></frame>
      <link name="lower"><collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision></link>
      <link name="upper">
        <pose relative_to="lower">0 0 1.5 0.2 0 0</pose>
        <collision name="c"><pose>0.1 0 0 0 0 1</pose>
          <geometry><cylinder><radius>0.2</radius><length>1</length></cylinder></geometry></collision>
        <collision name="d"><pose relative_to="shelf">0 0.5 0 0 0 0</pose>
          <geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
      </link>
      <model name="bin">
        <pose>0 0.4 0 0 0 0.3</pose>
        <link name="link"><pose>0 0 0.2 0 0 0</pose>
          <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link>
      </model>
    </model>
    <model name="post">
      <pose relative_to="gate">0 0 1 0 0 0</pose>
      <static>true</static>
      <link name="link"><collision name="c"><geometry><box><size>0.1 0.1 2</size></box></geometry></collision></link>
    </model>
    <include><uri>model://crate</uri><name>crate_1</name><pose>-3 1 0 0 0 0.5</pose></include>
    <include><uri>model://crate</uri><name>crate_2</name><pose relative_to="dock">1 1 0 0 0 0</pose></include>
    <include><uri>model://crate</uri></include>
    <include><uri>model://crate</uri><pose>3 3 3 0 0 0</pose></include>
    <model name="moved"><static>true</static><pose>9 9 9 0 0 0</pose>
      <link name="link"><collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision></link>
    </model>
    <state world_name="default">
      <model name="moved"><pose>1 2 3 0 0 0.4</pose>
        <link name="link"><pose>1 2 3 0 0 0.4</pose></link></model>
      <model name="crate_1"><pose>-4 1 0 0 0 1.5</pose>
        <link name="link"><pose>-4 1 0 0 0 1.5</pose></link></model>
    </state>
  </world>
</sdf>
"""
CRATE = """<sdf version="1.6"><model name="crate"><static>true</static><pose>0.5 0 0.25 0 0 0.1</pose>
<link name="link"><pose>0 0.1 0 0 0 0</pose>
<collision name="c"><pose>0 0 0.3 0 0 0</pose><geometry><box><size>0.5 0.5 0.5</size></box></geometry></collision>
</link></model></sdf>
"""


def check_parity(context, world, *model_paths):
    require_gazebo(context)
    if not (context.plugins / "libtagfield_test_poses.so").exists():
        raise Skip(f"the plugins are not built ({context.plugins})")
    found = parity(world, context.plugins, context.build / "bin/world_poses",
                   [context.source / "models", *model_paths], context.folder)
    check(found is not None, f"Gazebo does not load {world}")
    check_equal(found.words, [], f"solids of {world}")
    return found.agree


@case
def frames_includes_and_states(context):
    model = context.folder / "models/crate"
    model.mkdir(parents=True)
    (model / "model.sdf").write_text(CRATE, encoding="utf-8")
    (model / "model.config").write_text(
        '<model><name>crate</name><version>1.0</version><sdf version="1.6">model.sdf</sdf></model>', encoding="utf-8")
    world = pathlib.Path(context.write("frames.sdf", WORLD))
    check_equal(check_parity(context, world, context.folder / "models"), 9, "solids")


@case
def the_warehouse(context):
    check(check_parity(context, context.source / "worlds/small_warehouse.sdf") > 100, "solids")


@case
def worlds_that_come_with_gazebo(context):
    require_gazebo(context)
    root = ROOT if (ROOT / "usr").exists() else pathlib.Path("/")
    folder = root / "usr/share/gazebo-11"
    for name in GAZEBOS:
        world = folder / f"worlds/{name}.world"
        if not world.exists():
            raise Skip(f"there is no {world}")
        check(check_parity(context, world, folder / "models", folder) > 0, f"solids of {name}")


if __name__ == "__main__":
    main()
