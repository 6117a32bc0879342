#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The plugins under AddressSanitizer in the real gzserver: load, reads, spawning, deletion, shutdown.

Needs plugins built with -fsanitize=address, as scripts/test --sanitize builds them.
"""

import contextlib
import pathlib
import re
import subprocess

from gazebo import (
    IN_GAZEBO, Run, antenna, antenna_sensor, case, check, check_equal, insert, lines_of_json,
    main, model, remove, require_gazebo, schedule, tag, tag_sensor, world)


def sanitizer(context):
    """Path of the sanitizer's library."""
    require_gazebo(context)
    library = subprocess.run([str(IN_GAZEBO), "g++", "-print-file-name=libasan.so"], check=True,
                             stdout=subprocess.PIPE, text=True).stdout.strip()
    return library


def ours(report):
    """The parts of a leak report with Tagfield's code in their stack traces."""
    return [part for part in report.split("\n\n")
            if re.search(r"leak of .* byte", part)
            and re.search(r"tagfield|libgazeboRfid|libTagfield", part)]


def is_sanitized(world_file):
    """Whether the gzserver with this world has the sanitizer's library loaded."""
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            words = (folder / "cmdline").read_bytes().split(b"\0")
            if words[0].endswith(b"gzserver") and world_file.encode() in words:
                return "libasan" in (folder / "maps").read_text(encoding="utf-8")
    return False


@case
def load_spawn_delete_and_shutdown_have_no_memory_errors(context):
    library = sanitizer(context)
    physical = "<model>multipath</model><inventory>gen2</inventory>"
    cart = model("cart", "0 0 1 0 0 0", antenna_sensor("reader", physical)
                 + tag_sensor("a") + tag_sensor("b"), static=False)
    wall = ('<model name="wall"><static>1</static><pose>0 3 1 0 0 0</pose><link name="link">'
            '<collision name="c"><geometry><box><size>9 0.1 2</size></box></geometry></collision>'
            '</link></model>')
    materials = ('<plugin name="materials" filename="libTagfieldMaterialsPlugin.so">'
                 '<made_of name="wall">brick</made_of></plugin>')
    rows = "".join(f'<tag epc="S{i}">{0.01 * i} 0 1</tag>' for i in range(200))
    shelf = (f'<model name="shelf"><static>true</static><link name="link"/>'
             f'<plugin name="tags" filename="libTagfieldTagSetPlugin.so">{rows}</plugin></model>')
    events = "".join(insert(1.0 + 0.02 * i, tag(f"tag{i}", i % 10, i // 10, 1)) for i in range(50))
    events += "".join(remove(3.0 + 0.02 * i, f"tag{i}") for i in range(0, 50, 2))
    events += remove(3.5, "cart") + insert(4.5, cart) + remove(4.0, "shelf")
    events += insert(1.5, wall) + remove(3.2, "wall")
    bad = antenna("bad", 1, 1, 1, "<range>-1</range>")
    log = context.folder / "schedule.log"
    text = world(materials, antenna("gate", 0, 0, 2), cart, shelf, bad, tag("rest", 1, 0, 1),
                 schedule(log, events, stop=6.0))
    report = context.folder / "asan"
    options = f"log_path={report}:detect_leaks=1:new_delete_type_mismatch=0:detect_odr_violation=0"
    with Run(context, text, command=("env", f"LD_PRELOAD={library}", "gzserver"),
             env={"ASAN_OPTIONS": options}) as running:
        listener = running.start("subscriber", context.build / "bin/tag_array_subscriber",
                                 "/gazebo/gate/data")
        running.wait_for("the schedule", lambda: log.exists() and "stopped" in log.read_text(),
                         400.0)
        check(running.is_alive(), "Gazebo has ended")
        check(lines_of_json(listener.log), "nothing was read")
        check(is_sanitized(str(running.world)), "gzserver runs without the sanitizer")
        running.server.stop(patience_s=120.0)
    reports = "\n\n".join(path.read_text(errors="replace")
                          for path in context.folder.glob("asan.*"))
    errors = re.findall(r"ERROR: AddressSanitizer: .*", reports)
    check_equal(errors, [], f"errors; the report begins {reports[:3000]}")
    leaks = ours(reports)
    check_equal(leaks[:2], [], "leaks through our code")


if __name__ == "__main__":
    main()
