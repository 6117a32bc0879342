#!/usr/bin/python3
"""Draws how the cost of an update grows with tags, mirrors and order, from propagation_benchmark.

    propagation_benchmark --benchmark_out=paths.json --benchmark_out_format=json
    plot_paths.py paths.json paths.svg
"""

import json
import math
import re
import sys

WORLDS = (("small warehouse", 0, "#2a6fbb"), ("AWS warehouse", 1, "#c2571a"))
WIDTH, HEIGHT, LEFT, TOP, GAP, SIDE = 960, 346, 62, 62, 84, 230


def medians(path):
    """[(settings, facets, ms)] of the median rows, or of all where there are no repetitions."""
    rows = json.load(open(path, encoding="utf-8"))["benchmarks"]
    rows = [row for row in rows if row.get("aggregate_name", "median") == "median"]
    scale = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
    found = []
    for row in rows:
        if not row["name"].startswith("update/"):
            continue
        settings = {key: int(value) for key, value in re.findall(r"(\w+):(\d+)", row["name"])}
        found.append((settings, row.get("facets"), row["cpu_time"] * scale[row["time_unit"]]))
    return found


def line_of(rows, world, key, fixed):
    points = []
    for settings, facets, ms in rows:
        usual = {"aws": world, "order": 2, "tags": 1000, "opaque": 1, "occlusion": 1, "cm2": 1000}
        usual.pop(fixed)
        if all(settings[name] == value for name, value in usual.items()):
            points.append((facets if key == "facets" else settings[key], ms))
    return sorted(points)


def ticks(low, high):
    return [10.0 ** e for e in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
            if low <= 10.0 ** e * 1.0001 and 10.0 ** e <= high * 1.0001]


def panel(left, title, lines, log_x, x_ticks):
    xs = [x for _, points in lines for x, _ in points]
    low_y, high_y = 0.1, 1000.0
    scale = math.log10 if log_x else float
    low_x, high_x = scale(min(xs)), scale(max(xs))
    at_x = lambda x: left + SIDE * (scale(x) - low_x) / (high_x - low_x or 1)
    at_y = lambda y: TOP + SIDE * (1 - math.log10(y / low_y) / math.log10(high_y / low_y))
    svg = [f'<text x="{left + SIDE / 2}" y="{TOP - 16}" class="title">{title}</text>']
    for y in ticks(low_y, high_y):
        svg.append(f'<path d="M{left} {at_y(y):.1f}h{SIDE}" class="grid"/><text x="{left - 8}" '
                   f'y="{at_y(y) + 4:.1f}" class="y">{y:g}</text>')
    svg.append(f'<path d="M{left} {at_y(1000 / 15):.1f}h{SIDE}" class="limit"/>')
    for x in x_ticks:
        svg.append(f'<text x="{at_x(x):.1f}" y="{TOP + SIDE + 20}" class="x">{x:,}</text>')
    for color, points in lines:
        way = " ".join(f"{at_x(x):.1f},{at_y(y):.1f}" for x, y in points)
        svg.append(f'<polyline points="{way}" stroke="{color}" class="line"/>')
        svg += [f'<circle cx="{at_x(x):.1f}" cy="{at_y(y):.1f}" r="3.5" fill="{color}"/>'
                for x, y in points]
    return "".join(svg)


def main():
    rows = medians(sys.argv[1])
    panels = []
    for i, (title, key, fixed, log_x, marks) in enumerate((
            ("tags (order 2)", "tags", "tags", True, (10, 100, 1000, 10000)),
            ("mirrors (order 2, 1,000 tags)", "facets", "cm2", False, (200, 400, 600)),
            ("order (1,000 tags)", "order", "order", False, (0, 1, 2, 3)))):
        lines = [(color, line_of(rows, world, key, fixed)) for _, world, color in WORLDS]
        panels.append(panel(LEFT + i * (SIDE + GAP), title, lines, log_x, marks))
    legend = "".join(f'<circle cx="{LEFT + 6 + 190 * i}" cy="14" r="4" fill="{color}"/><text '
                     f'x="{LEFT + 16 + 190 * i}" y="18">{name}</text>'
                     for i, (name, _, color) in enumerate(WORLDS))
    legend += (f'<path d="M{LEFT + 400} 14h26" class="limit"/><text x="{LEFT + 434}" y="18">'
               "an update's time at 15 Hz</text>")
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
            'font-family="sans-serif" font-size="12"><style>.title{text-anchor:middle;'
            "font-weight:bold}.x{text-anchor:middle}.y{text-anchor:end}.grid{stroke:#ddd}"
            ".limit{stroke:#777;stroke-dasharray:5 4}.line{fill:none;stroke-width:2}</style>"
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>{legend}'
            f'<text x="14" y="{TOP + SIDE / 2}" transform="rotate(-90 14 {TOP + SIDE / 2})" '
            f'text-anchor="middle">one update [ms]</text>{"".join(panels)}</svg>\n')


main()
