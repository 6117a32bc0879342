# SPDX-License-Identifier: Apache-2.0
"""Common parts of the tests in a real gz-sim: its server, worlds, and results of a run."""

import os
import pathlib
import re
import subprocess
import sys
import uuid

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(TOP / "tests/command"), str(TOP / "tests/gazebo")]
from common import (  # noqa: E402,F401  pylint: disable=wrong-import-position,unused-import
    Skip, case, check, check_equal, check_in, check_near, main, read_csv)

MISSING = ("gz-sim is not found: install Fortress, Harmonic or later, or name its folder in "
           "TAGFIELD_GZ_PREFIX, and build again (docs/gz.md)")
SYSTEMS = "".join(
    f'<plugin filename="gz-sim-{file}-system" name="gz::sim::systems::{name}"/>'
    for file, name in (("physics", "Physics"), ("user-commands", "UserCommands"),
                       ("scene-broadcaster", "SceneBroadcaster")))


def environment(context):
    """Environment with paths of plugins and models, and a separate transport partition."""
    prefix = os.environ.get("TAGFIELD_GZ_PREFIX", "")
    plugins = [str(context.build / "lib"), f"{prefix}/lib/ign-gazebo-6/plugins"]
    env = dict(os.environ)
    for name in ("GZ_SIM_SYSTEM_PLUGIN_PATH", "IGN_GAZEBO_SYSTEM_PLUGIN_PATH"):
        env[name] = ":".join(plugins)
    for name in ("GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH"):
        env[name] = str(context.build / "gz/models")
    for name in ("GZ_PARTITION", "IGN_PARTITION"):
        env[name] = uuid.uuid4().hex
    for name in ("GZ_IP", "IGN_IP"):
        env[name] = "127.0.0.1"
    if prefix:
        env["LD_LIBRARY_PATH"] = f"{prefix}/lib:" + os.environ.get("LD_LIBRARY_PATH", "")
    env["HOME"] = str(context.folder)
    return env


def require_server():
    """Ends the test as skipped, with one line, if no server was built."""
    build = pathlib.Path(sys.argv[sys.argv.index("--build") + 1])
    if not (build / "bin/gz_test_server").exists():
        print(f"skipped: {MISSING}")
        sys.exit(77)


def serve(context, world, script, before=()):
    """Runs the script in a server with the world's text, with the words of `before` as a prefix of the
    command; returns its output."""
    server = context.build / "bin/gz_test_server"
    if not server.exists():
        raise Skip(MISSING)
    path = context.write("served.sdf", world)
    name = re.search(r'<world name="([^"]*)"', world).group(1)
    lines = context.write("script", "\n".join([name, *script, ""]))
    done = subprocess.run([*before, str(server), str(path), str(lines)], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=200, check=False, cwd=context.folder,
                          env=environment(context))
    said = re.sub(r"\x1b\[[0-9;]*m", "", done.stdout.decode("utf-8", "replace"))
    check(done.returncode == 0, f"the server's exit code is {done.returncode}: {said[-2000:]}")
    return said


def world(*parts, settings=""):
    """A world without gravity that records Tagfield's messages."""
    return (f'<?xml version="1.0"?><sdf version="1.8"><world name="hall">{SYSTEMS}'
            f'<plugin filename="tagfield-gz" name="tagfield::systems::Rfid"><ros2>false</ros2>'
            f'<mcap>run.mcap</mcap>{settings}</plugin><gravity>0 0 0</gravity>'
            f'<physics name="p" type="ode"><max_step_size>0.001</max_step_size>'
            f'<real_time_factor>0</real_time_factor></physics>{"".join(parts)}</world></sdf>')


def model(name, pose, sensors, static=True):
    return (f'<model name="{name}"><static>{int(static)}</static><pose>{pose}</pose>'
            f'<link name="link">{sensors}</link></model>')


def sensor(name, kind, parameters="", more="", prefix="gz"):
    inside = f"<{prefix}:{kind}>{parameters}</{prefix}:{kind}>" if parameters else ""
    return f'<sensor name="{name}" type="custom" {prefix}:type="{kind}">{more}{inside}</sensor>'


def antenna(name, x, y, z, parameters="<range>1000</range>"):
    return model(name, f"{x} {y} {z} 0 0 0",
                 sensor(name, "rfid_antenna", parameters, "<update_rate>15</update_rate>"))


def tag(name, x, y, z, parameters="", static=True):
    return model(name, f"{x} {y} {z} 0 0 0", sensor("tag", "rfid_tag", parameters), static)


def errors(said):
    """Lines of the output with an error; their format changed in Ionic."""
    return [line for line in said.split("\n") if "[Err]" in line or "[error]" in line]


def recorded(context, said_by="run.mcap", name="located"):
    """Localizes from a server's recording and returns the results folder."""
    folder = context.folder / name
    context.run_well("localize", context.folder / said_by, "--tag-height", "1", "--out", folder)
    return folder
