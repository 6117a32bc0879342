# SPDX-License-Identifier: Apache-2.0
"""Antenna placement."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Mapping

from . import _core
from ._checks import called, flag, number, path_of, progress_of, seed_of, whole
from ._scenario import Scenario, _changes, _Source, threads_of
from ._tables import frame_of
from ._warnings import tell

if TYPE_CHECKING:
    import pandas

__all__ = ["Plan", "plan"]


class Plan:
    """Optimized antenna layouts with one antenna, two, and so on; str() returns the command's output.

    data: the content of plan.json: layouts, positions that are hard to read, sensitivity, check. See
        docs/plan.md.
    layout: the chosen layout as a scenario (YAML).
    """

    def __init__(self, parts: Mapping[str, Any]) -> None:
        self._parts = dict(parts)
        self.data: dict[str, Any] = json.loads(parts["json"])
        self.layout: str = parts["layout"]
        self.warnings: list[str] = tell(parts["warnings"])

    def __str__(self) -> str:
        return self._parts["text"]

    def __repr__(self) -> str:
        read = self.chosen["read"]["mean"]
        return (f"<tagfield.Plan {self.data['scenario']}: {self.data['chosen_antennas']} antennas, "
                f"{read:.1f} of {self.data['tags']} tags>")

    @property
    def chosen(self) -> dict[str, Any]:
        """The chosen one of the layouts in `data`.

        Its keys include antennas, readers, cost, score, share, bound, read {mean, low, high}, zones.
        """
        count = self.data["chosen_antennas"]
        return next(one for one in self.data["layouts"] if len(one["antennas"]) == count)

    @property
    def scenario(self) -> Scenario:
        """The chosen layout with one random sample of its tags, as a scenario to run."""
        return Scenario._from("plan", _Source(text=self.layout, name=self.data["scenario"] + "_layout",
                                              allow_outside=True))

    def layouts(self) -> pandas.DataFrame:
        """One row per number of antennas, as a pandas.DataFrame."""
        return frame_of(self._parts["layouts_csv"])

    def antennas(self) -> pandas.DataFrame:
        """One row per antenna of each layout, as a pandas.DataFrame."""
        return frame_of(self._parts["antennas_csv"])

    def positions(self) -> pandas.DataFrame:
        """One row per tag position, with its read probability p_N by number of antennas N."""
        return frame_of(self._parts["positions_csv"])

    def save_page(self, path: str | os.PathLike) -> None:
        """Writes a self-contained HTML page with a floor plan of each layout."""
        Path(path).write_text(self._parts["html"], encoding="utf-8")

    def save_layout(self, path: str | os.PathLike) -> None:
        """Writes the chosen layout as a scenario file."""
        Path(path).write_text(self.layout, encoding="utf-8")


def plan(path: str | os.PathLike, *changes: str | Mapping[str, Any], seed: int | None = None,
         samples: int = 32, check: int = 0, exact_s: float = 0.0, links: str | os.PathLike = "",
         threads: int | None = None, progress: Callable[[float], Any] | None = None,
         skip_missing: bool = False, allow_outside: bool = False) -> Plan:
    """Optimizes antenna placement for a scenario file with a section ``plan`` (docs/plan.md).

        made = tagfield.plan(tagfield.share("scenarios/plan/store.yaml"), {"plan.limits.antennas": 4}, check=20)
        made.scenario.run(seed=2)

    changes: changes to the scenario, as for Scenario.with_().
    samples: number of samples per forecast, 8 to 10000.
    check: number of full simulation runs of the chosen layout, with other tags and seeds.
    exact_s: time limit [s] for an integer program that searches for a better layout (requires CBC).
    links: folder that caches the links. With it, an interrupted plan resumes, and plans with other
        limits or aims don't compute them again.
    progress: called now and then with the completed share, 0 to 1, and at the end with 1. Ctrl-C raises
        KeyboardInterrupt.
    """
    samples = whole("plan: samples", samples, 8, 10_000)
    check = whole("plan: check", check, 0, 10_000)
    if not 0.0 <= number("plan: exact_s", exact_s) <= 86_400.0:
        raise _core.Error(f"plan: exact_s is {exact_s}, expected 0 to 86400")
    seed = None if seed is None else seed_of("plan", seed)
    return Plan(called("plan", _core.plan, path_of("plan: path", path), _changes("plan", changes, {}),
                       flag("plan: skip_missing", skip_missing), flag("plan: allow_outside", allow_outside), seed,
                       samples, check, exact_s, path_of("plan: links", links), threads_of(threads),
                       progress_of("plan", progress)))
