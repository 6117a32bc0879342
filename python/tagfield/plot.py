# SPDX-License-Identifier: Apache-2.0
"""Plots with matplotlib: each function draws into `ax`, or into a new figure, and returns the Axes.

Colours are safe for colour-blind readers; ordered quantities use the perceptually uniform scale viridis.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from . import sar
from ._core import Error

if TYPE_CHECKING:
    from ._bench import Bench
    from ._runs import Coverage, Localization, Run, Tracks
    from ._scenario import Scenario

__all__ = ["bench", "coverage", "errors", "hall", "phase", "rssi", "sar_image", "tracks", "world"]

# The colour-blind-safe palette of Okabe and Ito.
_BLUE, _ORANGE, _GREEN, _PURPLE, _GREY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#8a8a8a"
_SERIES = (_BLUE, _ORANGE, _GREEN, _PURPLE, "#56B4E9", "#E69F00", "#4d4d4d", "#F0E442")


def _axes(ax: Axes | None, size: tuple[float, float] = (7.0, 5.0)) -> Axes:
    return plt.subplots(figsize=size, layout="constrained")[1] if ax is None else ax


def _plan(ax: Axes) -> None:
    """Labels the axes of a floor plan and gives them equal scales."""
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")


def world(scenario: Scenario, ax: Axes | None = None, low_m: float = 0.2, high_m: float = 2.0) -> Axes:
    """Draws outlines of the scenario's world between two heights [m], seen from above."""
    ax = _axes(ax)
    for _, rings in scenario.outlines(low_m, high_m):
        closed = [np.vstack([ring, ring[:1]]) for ring in rings if len(ring) > 2]
        if not closed:
            continue
        codes = [np.r_[Path.MOVETO, np.full(len(ring) - 2, Path.LINETO), Path.CLOSEPOLY] for ring in closed]
        path = Path(np.vstack(closed), np.concatenate(codes))
        ax.add_patch(PathPatch(path, facecolor="#d9d9d9", edgecolor="#9a9a9a", linewidth=0.6, zorder=0))
    ax.autoscale_view()
    _plan(ax)
    return ax


def hall(run: Run, ax: Axes | None = None, *, legend: bool = True) -> Axes:
    """Draws the floor plan with antenna paths, true positions, estimates and candidates of the tags."""
    ax = world(run.scenario, _axes(ax))
    for antenna in dict.fromkeys(run.poses.names("name")):
        track = run.poses.where(name=antenna)["position_m"]
        if len(track) == 1:
            ax.plot(*track[0, :2], "s", color=_BLUE, markersize=7, label="antenna at rest")
        else:
            ax.plot(track[:, 0], track[:, 1], color=_BLUE, linewidth=1.4, label="antenna's path")
    truth = np.array(list(run.truth.positions_m().values())).reshape(-1, 3)
    ax.plot(truth[:, 0], truth[:, 1], "o", markerfacecolor="none", markeredgecolor="black", markersize=9,
            label="true position")
    _estimates(run, ax)
    if legend:
        _legend(ax)
    errors_m = run.errors_m
    said = f", mean error {1e3 * errors_m.mean():.1f} mm" if len(errors_m) else ""
    ax.set_title(f"{run.scenario.name}: {run.located_of}{said}")
    return ax


def _estimates(found: Localization, ax: Axes) -> None:
    places = found.estimates["position_m"][found.located]
    ax.plot(places[:, 0], places[:, 1], "+", color=_ORANGE, markersize=10, markeredgewidth=1.8,
            label="estimate")
    ambiguous = found.estimates.where(verdict="ambiguous").names("tag")
    candidates = found.candidates.where(tag=list(ambiguous))["position_m"]
    if len(candidates):
        ax.plot(candidates[:, 0], candidates[:, 1], "x", color=_PURPLE, markersize=7, label="candidate")


def _legend(ax: Axes) -> None:
    """Adds a legend to the right of the axes, with each label once."""
    handles, labels = ax.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    ax.legend(unique.values(), unique.keys(), loc="upper left", bbox_to_anchor=(1.02, 1.0), frameon=False)


def phase(run: Run, tag: str, ax: Axes | None = None, *, antenna: str = "") -> Axes:
    """Plots the reported phase of a tag over time, with one colour per antenna."""
    return _over_time(run, tag, antenna, "phase_rad", "phase [rad]", ax)


def rssi(run: Run, tag: str, ax: Axes | None = None, *, antenna: str = "") -> Axes:
    """Plots the reported RSSI of a tag over time, with one colour per antenna."""
    return _over_time(run, tag, antenna, "rssi_dbm", "RSSI [dBm]", ax)


def _over_time(run: Run, tag: str, antenna: str, column: str, label: str, ax: Axes | None) -> Axes:
    reads = run.reads[run.reads._are("tag", [tag])]
    if antenna:
        reads = reads[reads._are("antenna", [antenna])]
    if len(reads) == 0:
        raise Error(f"plot: there are no reads of tag '{tag}'" + (f" by '{antenna}'" if antenna else ""))
    ax = _axes(ax, (7.0, 3.2))
    for color, name in zip(_SERIES, dict.fromkeys(reads.names("antenna")), strict=False):
        of_antenna = reads.where(antenna=name)
        ax.plot(of_antenna.time_s, of_antenna[column], ".", color=color, markersize=3, label=name)
    ax.set_xlabel("time [s]")
    ax.set_ylabel(label)
    ax.set_title(f"{tag}: {len(reads)} reads")
    if len(ax.lines) > 1:
        _legend(ax)
    return ax


def errors(results: Localization | Sequence[Localization] | dict[str, Any], ax: Axes | None = None) -> Axes:
    """Plots the cumulative distribution (CDF) of the errors of located tags.

    results: one result, a sequence of results that are pooled, or either by label.
    """
    groups = results if isinstance(results, dict) else {"": results}
    ax = _axes(ax, (7.0, 4.0))
    for color, (label, group) in zip(_SERIES, groups.items(), strict=False):
        group = [group] if not isinstance(group, (list, tuple)) else group
        values = np.sort(np.concatenate([one.errors_m for one in group]))
        if len(values):
            share = np.arange(1, len(values) + 1) / len(values)
            ax.step(1e3 * values, share, where="post", color=color, linewidth=1.8,
                    label=f"{label or 'mean'}: {1e3 * values.mean():.1f} mm on average")
    ax.set_xscale("log")
    ax.set_ylim(0, 1.02)
    ax.set_xlabel("error [mm]")
    ax.set_ylabel("share of located tags")
    ax.grid(alpha=0.3)
    ax.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.17))
    return ax


_QUANTITIES = {"probability": ("read probability", 0.0, 1.0), "margin_db": ("margin [dB]", -10.0, 30.0),
               "power_dbm": ("power at the tag [dBm]", -30.0, 10.0),
               "reply_dbm": ("reply at the reader [dBm]", -90.0, -30.0)}


def coverage(covered: Coverage, quantity: str = "probability", layer: int = 0,
             ax: Axes | None = None) -> Axes:
    """Draws a coverage map of probability, margin_db, power_dbm or reply_dbm at one height.

    layer: index of the height in ``covered.layers``.
    """
    if quantity not in _QUANTITIES:
        raise Error(f"plot: '{quantity}' is none of {', '.join(_QUANTITIES)}")
    ax = _axes(ax)
    of_layer = covered.layers[layer]
    values = np.asarray(of_layer.cells[quantity])
    label, low, high = _QUANTITIES[quantity]
    if covered.by_paper and quantity == "power_dbm":
        label, low, high = "RSSI [dBm]", -60.0, -10.0
    half = covered.step_m / 2
    picture = ax.imshow(np.ma.masked_less(values, -250.0), origin="lower", vmin=low, vmax=high, cmap="viridis",
                        extent=(covered.x_m[0] - half, covered.x_m[-1] + half, covered.y_m[0] - half,
                                covered.y_m[-1] + half))
    ax.figure.colorbar(picture, ax=ax, label=label, shrink=0.85)
    for _, rings in covered.scenario.outlines():
        for ring in rings:
            ax.plot(*np.vstack([ring, ring[:1]]).T, color="white", linewidth=0.8, alpha=0.8)
    read = covered.tags["probability"] >= 0.5
    places = covered.tags["position_m"]
    for chosen, marker, name in ((read, "o", "tag, read"), (~read, "X", "tag, not read")):
        if chosen.any():
            ax.plot(places[chosen, 0], places[chosen, 1], marker, linestyle="", markerfacecolor=_ORANGE,
                    markeredgecolor="white", markersize=7, label=name)
    ax.set_xlim(covered.x_m[0] - half, covered.x_m[-1] + half)
    ax.set_ylim(covered.y_m[0] - half, covered.y_m[-1] + half)
    _plan(ax)
    if len(covered.tags):
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2, frameon=False)
    ax.set_title(f"{covered.scenario.name}, {of_layer.height_m:.2f} m: "
                 f"{100 * of_layer.share_read:.0f} % of the area read")
    return ax


def sar_image(run: Run, tag: str, ax: Axes | None = None, *, radius_m: float = 1.0,
              step_m: float = 0.02) -> Axes:
    """Draws the SAR image (matched filter, tagfield.sar.image) of a tag around its true position."""
    ax = _axes(ax, (6.0, 5.0))
    places = run.truth.positions_m()
    if tag not in places:
        raise Error(f"plot: there is no tag '{tag}'")
    x, y, z = places[tag]
    xs = np.arange(x - radius_m, x + radius_m, step_m)
    ys = np.arange(y - radius_m, y + radius_m, step_m)
    values = sar.image(run.reads, run.poses, tag, xs, ys, z)
    picture = ax.imshow(values, origin="lower", cmap="viridis", vmin=0.0, vmax=1.0,
                        extent=(xs[0] - step_m / 2, xs[-1] + step_m / 2, ys[0] - step_m / 2,
                                ys[-1] + step_m / 2))
    ax.figure.colorbar(picture, ax=ax, label="share of phases that fit")
    ax.plot(x, y, "o", markerfacecolor="none", markeredgecolor="white", markersize=11, label="true position")
    row, column = np.unravel_index(values.argmax(), values.shape)
    ax.plot(xs[column], ys[row], "+", color=_ORANGE, markersize=12, markeredgewidth=2, label="maximum")
    ax.legend(labelcolor="white", frameon=False)
    _plan(ax)
    ax.set_title(f"{tag}: SAR image, maximum {values.max():.2f}")
    return ax


def tracks(found: Tracks, ax: Axes | None = None, scenario: Scenario | None = None) -> Axes:
    """Draws the best track of each tag, seen from above, with an arrow at its end."""
    ax = _axes(ax, (8.0, 4.0)) if scenario is None else world(scenario, _axes(ax, (8.0, 4.0)))
    best = found.points[found.points["number"] == 1]
    tags = list(dict.fromkeys(best.names("tag")))
    for i, tag in enumerate(tags):
        places = best.where(tag=tag)["position_m"]
        color = plt.get_cmap("viridis")(i / max(len(tags) - 1, 1))
        ax.plot(places[:, 0], places[:, 1], color=color, linewidth=1.5, label=tag)
        if len(places) > 1:
            ax.annotate("", places[-1, :2], places[-2, :2],
                        arrowprops={"arrowstyle": "->", "color": color, "lw": 1.5})
    _plan(ax)
    if tags:
        _legend(ax)
    return ax


def bench(compared: Bench, ax: Axes | None = None, column: str = "mean_m") -> Axes:
    """Draws a heat map of the mean error, or another column of bench.csv, by condition and method."""
    rows = compared.to_pandas().pivot(index="condition", columns="name", values=column)
    order = list(dict.fromkeys(compared.to_pandas()["condition"]))
    names = list(dict.fromkeys(compared.to_pandas()["name"]))
    rows = rows.reindex(index=order, columns=names)
    scale = 1e3 if column.endswith("_m") else 1.0
    values = scale * rows.to_numpy(dtype=float)
    ax = _axes(ax, (2.2 + 1.1 * len(names), 1.4 + 0.5 * len(order)))
    from matplotlib.colors import LogNorm

    finite = values[np.isfinite(values) & (values > 0)]
    norm = LogNorm(finite.min(), finite.max()) if finite.size and finite.max() > 3 * finite.min() else None
    ax.imshow(values, cmap="viridis_r", aspect="auto", norm=norm)
    for (i, j), value in np.ndenumerate(values):
        best = np.isfinite(value) and value == np.nanmin(values[i])
        dark = np.isfinite(value) and finite.size and value > np.sqrt(finite.min() * finite.max())
        ax.text(j, i, f"{value:.3g}" if np.isfinite(value) else "–", ha="center", va="center",
                color="white" if dark else "black", weight="bold" if best else "normal")
    ax.set_xticks(range(len(names)), names)
    ax.set_yticks(range(len(order)), order)
    ax.set_title(f"{column[:-2]} error [mm]" if column.endswith("_m") else column)
    return ax
