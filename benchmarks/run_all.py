#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs all benchmarks and writes a page with scaling curves, fitted exponents and all figures.

    benchmarks/run_all.py [--quick] [--only NAME…] [--out build/bench] [--keep]

Each program runs between two runs of a fixed loop (calibration_benchmark); CPU times are compared with
those of the last release (benchmarks/last_release.json) as ratios to that loop, so that the machine
matters little. Writes figures.json, curves.svg and index.html into --out. --keep stores the ratios as
those of the last release. scripts/bench builds the programs.
"""

import argparse
import contextlib
import html
import json
import os
import pathlib
import re
import subprocess
import sys

import growth

TOP = pathlib.Path(__file__).resolve().parent.parent
RELEASE = TOP / "benchmarks/last_release.json"
PROGRAMS = ("simulation", "radio", "propagation", "gen2", "laser", "localization", "files", "navigation")
MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
CHANGED = 1.2  # Ratios above this, or below its inverse, are listed.


def run_program(bin_folder, name, min_time):
    """Runs a Google Benchmark program and returns its rows."""
    out = bin_folder.parent / f"{name}_benchmark.json"
    with open(os.devnull, "w", encoding="utf-8") as nowhere:
        subprocess.run([bin_folder / f"{name}_benchmark", f"--benchmark_out={out}",
                        "--benchmark_out_format=json", f"--benchmark_min_time={min_time}"],
                       check=True, stdout=nowhere, stderr=nowhere)
    rows = json.loads(out.read_text(encoding="utf-8"))["benchmarks"]
    out.unlink()
    return [row for row in rows if not row.get("error_occurred")]


def milliseconds(row):
    return row["cpu_time"] * MILLISECONDS[row["time_unit"]]


def figures_of(rows):
    """{name: CPU time [ms]}, with some figures repeated under the names that curves use."""
    figures = {row["name"]: milliseconds(row) for row in rows}
    for row in rows:
        settings = dict(re.findall(r"(\w+):(\d+)", row["name"]))
        usual = settings.get("opaque") == settings.get("occlusion") == "1" and settings["tags"] == "1000"
        if row["name"].startswith("update/") and usual:
            if settings["order"] == "2":
                figures[f"facets/aws:{settings['aws']}/{row['facets']:.0f}"] = milliseconds(row)
            if settings["cm2"] == "1000":
                figures[f"orders/aws:{settings['aws']}/{settings['order']}"] = milliseconds(row)
    return figures


def table_of(script, *arguments):
    """Rows, split into words, that a script prints below its header line."""
    printed = subprocess.run([TOP / "benchmarks" / script, *map(str, arguments)], check=True,
                             stdout=subprocess.PIPE, text=True).stdout
    return [line.replace(",", "").split() for line in printed.strip().split("\n")[1:]]


def command_figures(quick):
    figures = {}
    for hours, _, reads, method, cpu, _, peak, *_ in table_of(
            "long_drive.py", "--methods", "joint", "ml", "--hours", *((0.03, 0.06, 0.12) if quick
                                                                        else (0.05, 0.1, 0.2, 0.4))):
        figures[f"long_drive/{method}/cpu_s/{reads}"] = float(cpu)
        figures[f"long_drive/{method}/peak_mb/{reads}"] = float(peak)
    for hours, _, reads, _, peak, seconds in table_of(
            "long_run.py", "--hours", *((0.1, 0.3, 1) if quick else (0.3, 1, 3, 10))):
        figures[f"long_run/time_s/{reads}"] = float(seconds)
        figures[f"long_run/peak_mb/{reads}"] = float(peak)
    return figures


def measure(bin_folder, names, quick):
    """({name: figure}, {name: ratio to the calibration loop})."""
    figures, ratios = {}, {}
    min_time = 0.1 if quick else 0.5
    loop = milliseconds(run_program(bin_folder, "calibration", 0.5)[0])
    for name in names:
        progress(f"{name}_benchmark")
        rows = run_program(bin_folder, name, min_time)
        after = milliseconds(run_program(bin_folder, "calibration", 0.5)[0])
        figures.update(figures_of(rows))
        ratios.update({row["name"]: milliseconds(row) / min(loop, after) for row in rows})
        loop = after
    return figures, ratios


def progress(what):
    if sys.stderr.isatty():
        print(f"\r{what} …\033[K", end="", file=sys.stderr, flush=True)


def compared(ratios):
    """Lines that list what is slower or faster than in the last release."""
    if not RELEASE.exists():
        return ["no figures of a release to compare with (--keep writes them)"]
    before = json.loads(RELEASE.read_text(encoding="utf-8"))
    both = [(ratios[name] / before[name], name) for name in sorted(ratios) if name in before]
    lines = [f"{len(both)} figures of the last release, as ratios to the calibration loop:"]
    lines += [f"  {'slower' if ratio > 1 else 'faster'}  × {ratio:.2f}  {name}"
              for ratio, name in sorted(both, reverse=True) if not 1 / CHANGED < ratio < CHANGED]
    within = sum(1 for ratio, _ in both if 1 / CHANGED < ratio < CHANGED)
    return lines + [f"  {within} others within × {CHANGED}"]


def law_rows(found):
    return "".join(
        f"<tr><td>{html.escape(panel.title)}: {html.escape(label)}</td><td>{html.escape(panel.up)}</td>"
        f"<td>{html.escape(panel.across)}</td><td>{points[0][0]:,.0f} … {points[-1][0]:,.0f}</td>"
        f"<td>{points[0][1]:.3g} … {points[-1][1]:.3g}</td><td>{html.escape(law)}</td></tr>"
        for panel, lines in found for label, points, law in lines)


def page(found, svg, figures, comparison):
    rows = "".join(f"<tr><td><code>{html.escape(name)}</code></td><td>{value:.4g}</td></tr>"
                   for name, value in sorted(figures.items()))
    return f"""<!doctype html><html lang="en"><meta charset="utf-8"><title>Tagfield: benchmarks</title>
<meta name="viewport" content="width=device-width"><style>
body{{font:15px/1.5 sans-serif;max-width:64rem;margin:2rem auto;padding:0 1rem;color:#222;background:#fff}}
table{{border-collapse:collapse}}td,th{{padding:.15rem .7rem;border-bottom:1px solid #ddd;text-align:left}}
svg{{width:100%;height:auto}}pre{{overflow:auto}}</style>
<h1>Benchmarks</h1><p>CPU time of one core unless a figure says otherwise, on this machine
({os.cpu_count()} processors).</p>
<h2>How cost grows</h2>{svg}
<table><tr><th>What</th><th>y</th><th>x</th><th>x from … to</th><th>y from … to</th><th>Growth</th></tr>{law_rows(found)}</table>
<h2>Against the last release</h2><pre>{html.escape(chr(10).join(comparison))}</pre>
<h2>All figures</h2><p>CPU time [ms], or what the name says.</p><table>{rows}</table></html>
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--bin", type=pathlib.Path, default=TOP / "build/release/bin",
                        help="folder of the benchmark programs")
    parser.add_argument("--out", type=pathlib.Path, default=TOP / "build/bench")
    parser.add_argument("--only", nargs="+", choices=[*PROGRAMS, "commands"], default=None,
                        help="some of the parts")
    parser.add_argument("--quick", action="store_true", help="shorter and less exact")
    parser.add_argument("--keep", action="store_true", help="take the figures for the last release's")
    arguments = parser.parse_args()
    names = [name for name in PROGRAMS if arguments.only is None or name in arguments.only]
    figures, ratios = measure(arguments.bin, names, arguments.quick)
    if arguments.only is None or "commands" in arguments.only:
        progress("whole commands")
        figures.update(command_figures(arguments.quick))
    with contextlib.suppress(OSError):
        progress("")
    found = growth.curves(figures)
    comparison = compared(ratios)
    arguments.out.mkdir(parents=True, exist_ok=True)
    svg = growth.picture(found)
    (arguments.out / "curves.svg").write_text(svg, encoding="utf-8")
    (arguments.out / "figures.json").write_text(
        json.dumps({"figures": figures, "ratios": ratios}, indent=1) + "\n", encoding="utf-8")
    (arguments.out / "index.html").write_text(page(found, svg, figures, comparison), encoding="utf-8")
    for panel, lines in found:
        for label, _, law in lines:
            print(f"{panel.title}, {label}: {panel.up} by {panel.across}: {law}")
    print("\n".join(comparison))
    if arguments.keep:
        kept = {name: float(f"{ratio:.4g}") for name, ratio in sorted(ratios.items())}
        RELEASE.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")
    print(f"page: {arguments.out / 'index.html'}")


if __name__ == "__main__":
    sys.exit(main())
