#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Cost of tags and antennas in a real gzserver, compared with the same worlds without plugins.

    benchmarks/gazebo_benchmark.py [--seconds 30] [--plugins build/gazebo/lib] [CASE…]

For each case: the time of one antenna update (separately for the physics thread and for the thread
that simulates the reads), the real-time factor, and the CPU load of the process in per cent of one
core. There is no ROS master, so no messages are sent. Needs scripts/gazebo-root and the plugins, as
built by scripts/test or scripts/demo --gazebo. BENCHMARK.md has results.
"""

import argparse
import json
import math
import os
import pathlib
import re
import signal
import socket
import subprocess
import tempfile
import time

TOP = pathlib.Path(__file__).resolve().parent.parent
IN_GAZEBO = str(TOP / "scripts/in-gazebo")
# By name: tags as models or as a set, number of tags, antennas, spacing of tags [m], with plugins.
CASES = {
    "empty": ("models", 0, 0, 1.0, False),
    "models_100_bare": ("models", 100, 1, 0.2, False),
    "models_100": ("models", 100, 1, 0.2, True),
    "models_300_bare": ("models", 300, 1, 0.2, False),
    "models_300": ("models", 300, 1, 0.2, True),
    "models_1000_bare": ("models", 1000, 1, 0.2, False),
    "models_1000": ("models", 1000, 1, 0.2, True),
    "set_10000_all_in_range": ("set", 10000, 1, 0.05, True),
    "set_10000_all_in_range_4_antennas": ("set", 10000, 4, 0.05, True),
    "set_10000_in_a_hall_4_antennas": ("set", 10000, 4, 0.5, True),
}
PLACES = ((0, 0), (2, 2), (-2, 2), (2, -2))


def plugin(filename, content, with_plugins):
    if not with_plugins:
        return ""
    return f'<plugin name="p" filename="{filename}">{content}</plugin>'


def world(kind, tags, antennas, spacing, with_plugins):
    """Tags on a square grid at 1 m height, antennas above its centre, 15 Hz, range 7 m, 1 ms steps."""
    parts = ['<?xml version="1.0"?><sdf version="1.6"><world name="default"><physics type="ode">'
             '<max_step_size>0.001</max_step_size>'
             '<real_time_update_rate>1000</real_time_update_rate></physics>']
    side = max(math.ceil(math.sqrt(tags)), 1)
    places = [((i % side - (side - 1) / 2) * spacing, (i // side - (side - 1) / 2) * spacing, 1.0)
              for i in range(tags)]
    for number, (x, y) in enumerate(PLACES[:antennas]):
        sensor = plugin("libgazeboRfidAntennaPlugin.so",
                        "<range>7</range><communication_gain>3</communication_gain>", with_plugins)
        parts.append(f'<model name="antenna{number}"><static>1</static><pose>{x} {y} 2 0 0 0</pose>'
                     f'<link name="link"><sensor name="antenna{number}" type="rfid">'
                     f'<update_rate>15</update_rate>{sensor}</sensor></link></model>')
    if kind == "models":
        sensor = plugin("libgazeboRfidTagPlugin.so", "", with_plugins)
        parts += [f'<model name="tag{i}"><static>1</static><pose>{x} {y} {z} 0 0 0</pose>'
                  f'<link name="link"><sensor name="tag" type="rfidtag">'
                  f'<update_rate>15</update_rate>{sensor}</sensor></link></model>'
                  for i, (x, y, z) in enumerate(places)]
    else:
        rows = "".join(f'<tag epc="E28011700000020{i:08X}">{x} {y} {z}</tag>'
                       for i, (x, y, z) in enumerate(places))
        parts.append('<model name="tags"><static>1</static><link name="link"/>'
                     + plugin("libTagfieldTagSetPlugin.so", rows, with_plugins) + "</model>")
    return "\n".join([*parts, "</world></sdf>"])


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def simulated_s(env):
    """Gazebo's simulation time [s], or None while it does not respond."""
    said = subprocess.run([IN_GAZEBO, "timeout", "20", "gz", "topic", "-e",
                           "/gazebo/default/world_stats", "-d", "1"], env=env, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    found = re.findall(r"sim_time \{\s*sec: (\d+)\s*nsec: (\d+)", said)
    return int(found[-1][0]) + 1e-9 * int(found[-1][1]) if found else None


def wait_for_time(env):
    while True:
        stamp = simulated_s(env)
        if stamp:
            return stamp


def process_of(path):
    """Process ID of the gzserver that runs this world."""
    for folder in pathlib.Path("/proc").iterdir():
        if folder.name.isdigit():
            words = (folder / "cmdline").read_bytes().split(b"\0")
            if words[0].endswith(b"gzserver") and str(path).encode() in words:
                return int(folder.name)
    raise RuntimeError("gzserver is not there")


def cpu_s(process):
    fields = pathlib.Path(f"/proc/{process}/stat").read_text(encoding="ascii")
    words = fields.rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def measure(name, seconds, plugins):
    with tempfile.TemporaryDirectory(prefix="tagfield-") as folder:
        path = pathlib.Path(folder) / "world.sdf"
        path.write_text(world(*CASES[name]), encoding="utf-8")
        env = {**os.environ, "HOME": folder, "GAZEBO_IP": "127.0.0.1", "ROS_IP": "127.0.0.1",
               "GAZEBO_MODEL_DATABASE_URI": "", "GAZEBO_PLUGIN_PATH": str(plugins),
               "GAZEBO_MASTER_URI": f"http://127.0.0.1:{free_port()}",
               "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}", "TAGFIELD_REPORT_COST": "1"}
        with open(f"{folder}/log", "w", encoding="utf-8") as log:
            begin = time.monotonic()
            server = subprocess.Popen([IN_GAZEBO, "gzserver", str(path)], env=env, stdout=log,
                                      stderr=subprocess.STDOUT)
        first = wait_for_time(env)
        loaded = time.monotonic() - begin
        process = process_of(path)
        wall, cpu = time.monotonic(), cpu_s(process)
        time.sleep(seconds)
        last = wait_for_time(env)
        wall, cpu = time.monotonic() - wall, cpu_s(process) - cpu
        os.kill(process, signal.SIGINT)
        server.wait(120)
        said = pathlib.Path(f"{folder}/log").read_text(encoding="utf-8", errors="replace")
    cost = re.search(r'\{"updates".*\}', said)
    return {"case": name, "loaded_s": round(loaded, 1),
            "real_time_factor": round((last - first) / wall, 3),
            "cpu_percent": round(100 * cpu / wall, 1),
            **(json.loads(cost.group()) if cost else {})}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--seconds", type=float, default=30.0, help="to measure for (default 30)")
    parser.add_argument("--plugins", type=pathlib.Path, default=TOP / "build/gazebo/lib")
    parser.add_argument("cases", nargs="*", metavar="CASE", help=", ".join(CASES))
    arguments = parser.parse_args()
    for name in arguments.cases or CASES:
        print(json.dumps(measure(name, arguments.seconds, arguments.plugins.resolve())), flush=True)


if __name__ == "__main__":
    main()
