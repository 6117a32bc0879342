# SPDX-License-Identifier: Apache-2.0
"""Where antennas go."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Mapping

from . import _core
from ._scenario import Scenario, _changes, _Source, threads_of
from ._tables import frame_of
from ._warnings import tell

if TYPE_CHECKING:
    import pandas

__all__ = ["Plan", "plan"]


class Plan:
    """Layouts of antennas, from one up: str() says what the command prints.

    data: the content of plan.json: layouts, hard places, sensitivity, the check. docs/plan.md says what it means.
    chosen: of the layouts, the one that was chosen. layout: that as a scenario (YAML).
    """

    def __init__(self, parts: Mapping[str, Any]) -> None:
        self._parts = dict(parts)
        self.data: dict[str, Any] = json.loads(parts["json"])
        self.layout: str = parts["layout"]
        self.warnings: list[str] = parts["warnings"]
        tell(self.warnings)

    def __str__(self) -> str:
        return self._parts["text"]

    def __repr__(self) -> str:
        read = self.chosen["read"]["mean"]
        return (f"<tagfield.Plan {self.data['scenario']}: {self.data['chosen_antennas']} antennas, "
                f"{read:.1f} of {self.data['tags']} tags>")

    @property
    def chosen(self) -> dict[str, Any]:
        """The chosen layout: antennas, readers, cost, score, share, bound, read {mean, low, high}, zones."""
        count = self.data["chosen_antennas"]
        return next(one for one in self.data["layouts"] if len(one["antennas"]) == count)

    @property
    def scenario(self) -> Scenario:
        """The chosen layout with one sample of its tags, to run."""
        return Scenario._from(_Source(text=self.layout, name=self.data["scenario"] + "_layout",
                                      allow_outside=True))

    def layouts(self) -> pandas.DataFrame:
        """A row for each number of antennas, as a pandas.DataFrame."""
        return frame_of(self._parts["layouts_csv"])

    def antennas(self) -> pandas.DataFrame:
        """A row for each antenna of each layout, as a pandas.DataFrame."""
        return frame_of(self._parts["antennas_csv"])

    def places(self) -> pandas.DataFrame:
        """A row for each place of tags, p_N by number of antennas, as a pandas.DataFrame."""
        return frame_of(self._parts["places_csv"])

    def save_page(self, path: str | os.PathLike) -> None:
        """Writes the page with all layouts from above (HTML, self-contained)."""
        Path(path).write_text(self._parts["html"], encoding="utf-8")

    def save_layout(self, path: str | os.PathLike) -> None:
        """Writes the chosen layout as a scenario's file."""
        Path(path).write_text(self.layout, encoding="utf-8")


def plan(path: str | os.PathLike, *changes: str | Mapping[str, Any], seed: int | None = None,
         samples: int = 32, check: int = 0, exact_s: float = 0.0, links: str | os.PathLike = "",
         threads: int | None = None, progress: Callable[[float], Any] | None = None,
         skip_missing: bool = False, allow_outside: bool = False) -> Plan:
    """Decides where antennas go: from a scenario's file with a section ``plan`` (docs/plan.md).

        made = tagfield.plan(tagfield.share("scenarios/plan/store.yaml"), {"plan.limits.antennas": 4}, check=20)
        made.scenario.run(seed=2)

    changes: as of Scenario.with_(). samples: of each forecast. check: this many runs of the chosen layout in full,
    with other tags and seeds. exact_s: seconds in which an integer program looks for a better one (needs CBC). links:
    a folder where links are kept, from which the same plan resumes, or plans with other limits and aims at once.
    progress: called with 0 … 1 now and then; Ctrl-C raises KeyboardInterrupt.
    """
    if not 8 <= samples <= 10_000:
        raise _core.Error(f"plan: samples is {samples}, expected 8 to 10000")
    if not 0 <= check <= 10_000:
        raise _core.Error(f"plan: check is {check}, expected 0 to 10000")
    if not 0.0 <= exact_s <= 86_400.0:
        raise _core.Error(f"plan: exact_s is {exact_s}, expected 0 to 86400")
    return Plan(_core.plan(os.fspath(path), _changes("plan", changes, {}), skip_missing, allow_outside, seed,
                           samples, check, exact_s, os.fspath(links), threads_of(threads), progress))
