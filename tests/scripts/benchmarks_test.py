#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Results of scripts/bench: growth laws, the comparison with the last release, and the page.

    benchmarks_test.py SOURCE_DIR BENCHMARKS_DIR
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

SOURCE, PROGRAMS = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
sys.path.insert(0, str(SOURCE / "benchmarks"))
import growth  # pylint: disable=import-error,wrong-import-position
import run_all  # pylint: disable=import-error,wrong-import-position


def check(condition, what):
    if not condition:
        raise SystemExit(f"FAILED: {what}")


def laws_of_exact_growth():
    points = [(10.0 ** k, 3.0 * 10.0 ** (1.5 * k)) for k in range(5)]
    factor, exponent = growth.power_law(points)
    check(abs(factor - 3.0) < 1e-9 and abs(exponent - 1.5) < 1e-12, f"{factor} · x^{exponent}")
    check(abs(growth.last_exponent(points) - 1.5) < 1e-12, "the last exponent")
    check(growth.step_law([(0, 2.0), (1, 10.0), (2, 50.0)]).startswith("× 5 a step, × 5 the last"), "steps")


def curves_take_what_was_measured():
    figures = {f"TagsInRange/{10 ** k}": 0.1 * 10 ** k for k in range(1, 5)}
    figures.update({f"orders/aws:0/{order}": 6.0 ** order for order in range(4)})
    figures.update({"Antennas/1": 1.0, "Antennas/4": 4.0})  # Too few points for a law.
    found = growth.curves(figures)
    check([panel.title for panel, _ in found] == ["Reads, paper's model", "Paths by order"], f"{found}")
    check(found[0][1][0][2] == "∝ x^1.00, at the end x^1.00", found[0][1][0][2])
    xml.etree.ElementTree.fromstring(growth.picture(found))


def the_page_of_a_program(folder):
    subprocess.run([SOURCE / "benchmarks/run_all.py", "--quick", "--only", "files", "--bin", PROGRAMS,
                    "--out", folder], check=True, stdout=subprocess.DEVNULL)
    measured = json.loads((folder / "figures.json").read_text(encoding="utf-8"))
    check(set(measured["figures"]) == {"write_reads", "read_reads"}, f"{measured}")
    check(all(ratio > 0.0 for ratio in measured["ratios"].values()), f"{measured}")
    check("write_reads" in (folder / "index.html").read_text(encoding="utf-8"), "the page")
    released = json.loads(run_all.RELEASE.read_text(encoding="utf-8"))
    check(set(measured["ratios"]) <= set(released), "figures that the last release does not have")
    slower = {name: 2.0 * ratio for name, ratio in released.items()}
    lines = run_all.compared(slower)
    check(sum("slower  × 2.00" in line for line in lines) == len(released), f"{lines[:3]}")


laws_of_exact_growth()
curves_take_what_was_measured()
with tempfile.TemporaryDirectory(prefix="benchmarks-") as name:
    the_page_of_a_program(pathlib.Path(name))
print("passed")
