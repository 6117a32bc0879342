#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Limits on untrusted scenarios and worlds (docs/security.md).

    security_test.py --tagfield PROGRAM --source SOURCE_DIR --build BUILD_DIR
"""

import hashlib
import http.server
import os
import re
import shutil
import threading

from common import Skip, case, check, check_equal, check_in, main, run

WORLD = """<?xml version="1.0"?>{head}
<sdf version="1.7"><world name="{name}"><model name="{name}"><static>true</static><link name="l">
<collision name="c"><geometry>{shape}</geometry></collision></link></model>{more}</world></sdf>
"""
BOX = "<box><size>1 1 1</size></box>"
SCENARIO = """name: {name}
description: {name}
duration_s: 1
world: {{path: world.sdf}}
antennas: [{{name: {name}, reader: {name}, pose: [0, 0, 1, 0, 0, 0], rate_hz: 10}}]
tags: [{{id: {name}, position: [2, 2, 1]}}]
"""


def world(context, name="w", head="", shape=BOX, more=""):
    return context.write("world.sdf", WORLD.format(name=name, head=head, shape=shape, more=more))


def state(folder):
    return {path.relative_to(folder): hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
            for path in sorted(folder.rglob("*"))}


@case
def entities_are_not_expanded(context):
    secret = context.write("secret", "the secret of this machine")
    entities = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 12))
    head = f'<!DOCTYPE s [<!ENTITY e0 "xxxxxxxxxx">{entities}<!ENTITY file SYSTEM "{secret.as_uri()}">]>'
    result = context.run("check", world(context, name="&e11;&file;", head=head), timeout=20)
    check("secret of this" not in result.out + result.err, "a file was read as an entity")
    check(len(result.out) < 10_000, f"{len(result.out)} bytes of output")


@case
def what_contains_itself_ends(context):
    more = "<include><uri>world.sdf</uri></include>"
    result = context.run("check", world(context, more=more), timeout=20)
    check_equal(result.code, 2, "a world that includes itself")
    check_in("includes itself", result.err, "a world that includes itself")
    for name, text in (("loop", "name: &a [*a]\n"), ("in_tags", "name: x\ntags: &a\n - *a\n"),
                       ("laughs", "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n" + "".join(
                           f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 12)))):
        result = context.run("check", context.write(f"{name}.yaml", text), timeout=20)
        check_equal((result.code, len(result.err.splitlines())), (2, 1), name)


@case
def nothing_is_fetched(context):
    """Neither models nor meshes are downloaded, even if they are given by URL."""
    asked = []

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            asked.append(self.path)
            self.send_error(404)

        def log_message(self, *arguments):
            pass

    server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
    address = f"http://127.0.0.1:{server.server_address[1]}"
    for more, shape in ((f"<include><uri>{address}/model</uri></include>", BOX),
                        ("", f"<mesh><uri>{address}/mesh.dae</uri></mesh>")):
        result = context.run("check", world(context, shape=shape, more=more), timeout=20)
        check_equal(result.code, 2, "exit code")
        check_in("can't find", result.err, "what it says")
    server.shutdown()
    server.server_close()
    check_equal(asked, [], "what was asked of the network")


@case
def names_are_text_wherever_they_are_shown(context):
    name = "</script><script>hit()</script><img src=x onerror=hit()>`$(hit)`;../../x"
    escaped = name.replace("<", "&lt;").replace(">", "&gt;")
    world(context, name=escaped)
    scenario = context.write("scenario.yaml", SCENARIO.format(name=f'"{name}"'))
    before = state(context.folder)
    context.run_well("run", scenario, "--out", "results")
    after = state(context.folder)
    written = {path for path in after if path not in before}
    check(all(path.parts[0] == "results" for path in written), f"written: {sorted(written)[:5]}")
    check_equal({path: after[path] for path in before}, before, "what was there before")
    page = (context.folder / "results/report.html").read_text(encoding="utf-8")
    check("<script>hit" not in page and "<img src=x" not in page, "a name became an element of the page")
    check_in("hit()", page, "the page")
    for figure in (context.folder / "results").rglob("*.svg"):
        check("<script" not in figure.read_text(encoding="utf-8"), figure.name)


@case
def a_scenarios_name_leads_nowhere_else(context):
    """Without --out, results are written below runs/, whatever the scenario's name is."""
    world(context)
    for name in ("../../evil", "/tmp/evil", "..", "a/b"):
        scenario = context.write("scenario.yaml", SCENARIO.format(name="s").replace("name: s\n", f"name: \"{name}\"\n", 1))
        before = state(context.folder)
        result = context.run("run", scenario, "--no-page")
        written = {path for path in state(context.folder) if path not in before}
        check(result.code == 2 or all(path.parts[0] == "runs" for path in written), f"{name}: {sorted(written)[:5]}")
    check(not (context.folder.parent.parent / "evil").exists(), "it was written outside")


@case
def no_process_is_started(context):
    """Checks the program's imported symbols. Other programs are started only by bench methods that are
    commands, which must be allowed (bench_test.py), and by `doctor`, whose commands are fixed in its
    source. fork() creates the process in which meshes are read (sdf/internal/worker_process.h)."""
    if shutil.which("nm") is None:
        raise Skip("nm is missing (binutils)")
    if "TAGFIELD_SANITIZED" in os.environ:
        raise Skip("a sanitizer stands in between for calls that start others")

    def starters(program):
        imports = run(["nm", "--dynamic", "--undefined-only", program]).out
        return re.findall(r"\b(system|popen|execve?|execl[pe]?|execvp?e?|posix_spawnp?|fork|vfork)@", imports)

    check(starters("/bin/bash"), "nothing is found where there is something")
    check_equal(sorted(starters(context.tagfield)), ["fork", "popen", "posix_spawn"], "what it imports")


if __name__ == "__main__":
    main()
