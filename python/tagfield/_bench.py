# SPDX-License-Identifier: Apache-2.0
"""Comparison of localization methods under many conditions with many seeds."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence

from . import _core
from ._scenario import Scenario, _flat, _value_text, load, threads_of
from ._tables import frame_of
from ._warnings import tell

if TYPE_CHECKING:
    import pandas

__all__ = ["Bench", "bench"]


class Bench:
    """Result of a comparison of methods; str() returns it as a table.

    docs/bench.md explains the columns.
    """

    def __init__(self, parts: Mapping[str, Any]) -> None:
        self._parts = dict(parts)
        self.data: dict[str, Any] = json.loads(parts["json"])
        self.warnings: list[str] = parts["warnings"]
        tell(self.warnings)

    def __str__(self) -> str:
        return self._parts["text"]

    def to_pandas(self) -> pandas.DataFrame:
        """One row per condition and method: located, mean_m, ratio_rms, nees_mean, …"""
        return frame_of(self._parts["csv"])

    def tags(self) -> pandas.DataFrame:
        """One row per condition, method, seed and tag, as a pandas.DataFrame."""
        return frame_of(self._parts["tags_csv"])

    def save_page(self, path: str | os.PathLike) -> None:
        """Writes a self-contained HTML page with all figures."""
        Path(path).write_text(self._parts["html"], encoding="utf-8")


def bench(what: str | os.PathLike | Scenario, methods: Sequence[Any] = (),
          conditions: Mapping[str, Any] | None = None, *, seeds: int | None = None, first_seed: int | None = None,
          phase_noise_rad: float | None = None, name: str | None = None, skip_missing: bool = False,
          allow_outside: bool = False, threads: int | None = None,
          progress: Callable[[float], Any] | None = None) -> Bench:
    """Compares methods on the same reads, by the same criteria and against the Cramér-Rao bound.

        tagfield.bench(scenario, ["hyperbola", mine], {"true pose": {}, "1 cm": {"pose.source": "noisy"}},
                       seeds=20)

    what: a scenario, the path of a scenario file, or the path of a suite file. A suite defines its own
        conditions and methods; only methods of your own can be added to them.
    methods: names, methods of your own, or (label, name, {setting: value}).
    conditions: by label, the changes to the scenario (a mapping as for Scenario.with_()) or another
        Scenario.
    seeds: number of seeds per condition, by default 1 or the suite's.
    first_seed: the first of them, by default 1 or the suite's.
    phase_noise_rad: phase noise for the bound, where the model states none.
    name: title of the comparison.
    skip_missing, allow_outside: for files, see :func:`load`.
    progress: called now and then with the completed share, 0 to 1. Ctrl-C raises KeyboardInterrupt.
    """
    own = [entry for entry in methods if isinstance(entry, _core.Method)]
    own += [entry[1] for entry in methods if isinstance(entry, tuple) and isinstance(entry[1], _core.Method)]
    if not isinstance(what, Scenario) and _is_suite(what):
        if conditions is not None or len(own) != len(methods):
            raise _core.Error("bench: a suite has its own conditions and methods: only your own methods can "
                              "be added")
        if phase_noise_rad is not None or name is not None:
            raise _core.Error("bench: a suite says phase_noise_rad and its name itself")
        return Bench(_core.bench_suite(os.fspath(what), own, seeds, first_seed, skip_missing, allow_outside,
                                       threads_of(threads), progress))
    if isinstance(what, Scenario) and (skip_missing or allow_outside):
        raise _core.Error("bench: skip_missing and allow_outside are of files: give them to tagfield.load()")
    scenario = what if isinstance(what, Scenario) else load(what, skip_missing=skip_missing,
                                                            allow_outside=allow_outside)
    if not methods:
        raise _core.Error("bench: methods is empty")
    entries = [_condition(scenario, label, changes, phase_noise_rad)
               for label, changes in (conditions or {scenario.name: {}}).items()]
    return Bench(_core.bench(name or "bench", [_method(entry) for entry in methods], entries, own,
                             1 if first_seed is None else first_seed,
                             1 if seeds is None else seeds, threads_of(threads), progress))


def _is_suite(path: str | os.PathLike) -> bool:
    """Whether the file is a suite: only suites have a key `conditions`."""
    return any(line.startswith("conditions:") for line in Path(path).read_text(encoding="utf-8").splitlines())


def _method(entry: Any) -> tuple[str, str, list[tuple[str, str]]]:
    if isinstance(entry, _core.Method):
        return entry.name, entry.name, []
    if isinstance(entry, str):
        return entry, entry, []
    label, method, settings = entry
    name = method.name if isinstance(method, _core.Method) else method
    return label, name, [(f"localization.{key}", _value_text(value, f"bench: {key}")) for key, value in settings.items()]


def _condition(scenario: Scenario, label: str, changes: Any, noise: float | None) -> tuple:
    if isinstance(changes, Scenario):
        return label, changes._source.for_core(), [], noise
    pairs = [pair for key, value in changes.items() for pair in _flat("bench", key, value)]
    return label, scenario._source.for_core(), pairs, noise
