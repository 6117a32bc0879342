# SPDX-License-Identifier: Apache-2.0
"""Scaling of cost: families of benchmarks, power laws fitted to them, and a plot of both.

Figures are {name: CPU time [ms]} and, for complete commands, {name: value}; a curve consists of those
whose names match its pattern, with the number in the name as x.
"""

import dataclasses
import html
import math
import re

COLORS = ("#2a6fbb", "#c2571a", "#3a8f4d", "#8b4fa8")
WIDTH, HEIGHT, LEFT, TOP = 250, 190, 52, 34
COLUMNS = 3


@dataclasses.dataclass
class Panel:
    title: str
    across: str  # What x counts.
    up: str
    lines: list  # (label, pattern with one group)
    by_steps: bool = False  # y grows exponentially with x, instead of by a power law.


PANELS = [
    Panel("Reads, paper's model", "tags in range of 4 antennas", "4 s simulated [ms]",
          [("4 s at 15 Hz", r"TagsInRange/(\d+)")]),
    Panel("Reads, paper's model", "antennas, 100 tags in range", "4 s simulated [ms]",
          [("4 s at 15 Hz", r"Antennas/(\d+)")]),
    Panel("A hall that grows with its tags", "tags, one to the m²", "4 s simulated [ms]",
          [("4 antennas", r"GrowingHall/(\d+)")]),
    Panel("Paths of order 2", "tags", "an update [ms]",
          [("small warehouse", r"update/aws:0/order:2/tags:(\d+)/opaque:1/occlusion:1/cm2:1000"),
           ("AWS warehouse", r"update/aws:1/order:2/tags:(\d+)/opaque:1/occlusion:1/cm2:1000")]),
    Panel("Paths of order 2", "mirrors, 1,000 tags", "an update [ms]",
          [("small warehouse", r"facets/aws:0/(\d+)"), ("AWS warehouse", r"facets/aws:1/(\d+)")]),
    Panel("Paths by order", "order, 1,000 tags", "an update [ms]",
          [("small warehouse", r"orders/aws:0/(\d+)"), ("AWS warehouse", r"orders/aws:1/(\d+)")],
          by_steps=True),
    Panel("Gen2 inventory", "tags in the field", "a simulated second [ms]",
          [("S0, dual target", r"dual_target_in_s0/(\d+)"),
           ("S2, target A", r"single_target_in_s2/(\d+)")]),
    Panel("Localization of a tag", "its reads", "CPU [ms]",
          [(name, rf"locate/{name}/reads:(\d+)") for name in ("hyperbola", "ml", "sar", "robust")]),
    Panel("tagfield localize, tags with reads", "reads", "CPU [s]",
          [(name, rf"long_drive/{name}/cpu_s/(\d+)") for name in ("joint", "ml")]),
    Panel("tagfield localize, tags with reads", "reads", "peak memory [MB]",
          [(name, rf"long_drive/{name}/peak_mb/(\d+)") for name in ("joint", "ml")]),
    Panel("tagfield run --record-only", "reads", "time [s]",
          [("10,000 tags", r"long_run/time_s/(\d+)")]),
    Panel("tagfield run --record-only", "reads", "peak memory [MB]",
          [("10,000 tags", r"long_run/peak_mb/(\d+)")]),
]


def points_of(pattern, figures):
    found = [(re.fullmatch(pattern, name), value) for name, value in figures.items()]
    return sorted((float(match.group(1)), value) for match, value in found if match and value > 0)


def step_law(points):
    """The growth factor of y per step of x, by least squares of log y, and that of the last step."""
    mean_x = sum(x for x, _ in points) / len(points)
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * math.log(y) for x, y in points) / spread
    (x0, y0), (x1, y1) = points[-2:]
    return f"× {math.exp(slope):.2g} a step, × {(y1 / y0) ** (1 / (x1 - x0)):.2g} the last"


def power_law(points):
    """(factor, exponent) of y = factor · x^exponent, by least squares of the logarithms."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    spread = sum((x - mean_x) ** 2 for x, _ in logs)
    exponent = sum((x - mean_x) * (y - mean_y) for x, y in logs) / spread
    return math.exp(mean_y - exponent * mean_x), exponent


def last_exponent(points):
    """The exponent between the two largest x, where fixed costs matter least."""
    (x0, y0), (x1, y1) = points[-2:]
    return math.log(y1 / y0) / math.log(x1 / x0)


def law_of(panel, points):
    if panel.by_steps:
        return step_law(points)
    return f"∝ x^{power_law(points)[1]:.2f}, at the end x^{last_exponent(points):.2f}"


def curves(figures):
    """[(panel, [(label, points, law)])] for curves with at least three measured points."""
    found = []
    for panel in PANELS:
        measured = [(label, points_of(pattern, figures)) for label, pattern in panel.lines]
        lines = [(label, points, law_of(panel, points)) for label, points in measured if len(points) > 2]
        if lines:
            found.append((panel, lines))
    return found


def short(value):
    for size, unit in ((1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:.3g}{unit}"
    return f"{value:.3g}"


def marks(low, high):
    """Tick values of a logarithmic axis: decades, and values between them if there are fewer than two."""
    for steps in ((1,), (1, 3), (1, 2, 5), range(1, 10)):
        found = [step * 10.0 ** e for e in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
                 for step in steps if low * 0.999 <= step * 10.0 ** e <= high * 1.001]
        if len(found) >= 2:
            return found[:: max(1, len(found) // 5)]
    return [low, high]


def panel_svg(left, top, panel, lines):
    xs = [x for _, points, _ in lines for x, _ in points]
    ys = [y for _, points, _ in lines for _, y in points]
    low_x, high_x, low_y, high_y = min(xs), max(xs), min(ys) / 1.3, max(ys) * 1.3
    if high_y / low_y < 10:
        middle = math.sqrt(high_y * low_y)
        low_y, high_y = middle / 10 ** 0.5, middle * 10 ** 0.5
    scale_x = float if panel.by_steps else math.log
    at_x = lambda x: left + WIDTH * (scale_x(x) - scale_x(low_x)) / (scale_x(high_x) - scale_x(low_x))
    at_y = lambda y: top + HEIGHT * (1 - math.log(y / low_y) / math.log(high_y / low_y))
    svg = [f'<text x="{left + WIDTH / 2}" y="{top - 14}" class="title">{html.escape(panel.title)}</text>',
           f'<rect x="{left}" y="{top}" width="{WIDTH}" height="{HEIGHT}" class="frame"/>',
           f'<text x="{left + WIDTH / 2}" y="{top + HEIGHT + 36}" class="x">{html.escape(panel.across)}</text>',
           f'<text transform="translate({left - 42} {top + HEIGHT / 2}) rotate(-90)" class="x">'
           f"{html.escape(panel.up)}</text>"]
    for x in sorted(set(xs)) if panel.by_steps else marks(low_x, high_x):
        svg.append(f'<path d="M{at_x(x):.1f} {top}v{HEIGHT}" class="grid"/>'
                   f'<text x="{at_x(x):.1f}" y="{top + HEIGHT + 17}" class="x">{short(x)}</text>')
    for y in marks(low_y, high_y):
        svg.append(f'<path d="M{left} {at_y(y):.1f}h{WIDTH}" class="grid"/>'
                   f'<text x="{left - 6}" y="{at_y(y) + 4:.1f}" class="y">{short(y)}</text>')
    for i, (label, points, law) in enumerate(lines):
        color = COLORS[i]
        way = " ".join(f"{at_x(x):.1f},{at_y(y):.1f}" for x, y in points)
        svg.append(f'<polyline points="{way}" stroke="{color}" class="line"/>')
        svg += [f'<circle cx="{at_x(x):.1f}" cy="{at_y(y):.1f}" r="3" fill="{color}"/>' for x, y in points]
        svg.append(f'<text x="{left}" y="{top + HEIGHT + 56 + 15 * i}" fill="{color}" class="law">'
                   f"{html.escape(label)}: {html.escape(law)}</text>")
    return "".join(svg)


def picture(found):
    pitch_x, pitch_y = WIDTH + 90, HEIGHT + 150
    rows = math.ceil(len(found) / COLUMNS)
    panels = [panel_svg(LEFT + 12 + pitch_x * (i % COLUMNS), TOP + pitch_y * (i // COLUMNS), panel, lines)
              for i, (panel, lines) in enumerate(found)]
    width, height = COLUMNS * pitch_x, rows * pitch_y
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
            'font-family="sans-serif" font-size="11"><style>.title{text-anchor:middle;font-weight:bold;'
            "font-size:13px}.x{text-anchor:middle}.y{text-anchor:end}.grid{stroke:#e2e2e2;fill:none}"
            ".frame{fill:none;stroke:#999}.line{fill:none;stroke-width:2}.law{font-size:12px}</style>"
            f'<rect width="{width}" height="{height}" fill="#fff"/>{"".join(panels)}</svg>\n')
