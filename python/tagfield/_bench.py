# SPDX-License-Identifier: Apache-2.0
"""Comparison of localization methods under many conditions with many seeds."""

from __future__ import annotations

import itertools
import json
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterable, Mapping, Sequence

from . import _core
from ._checks import called, flag, method_of, number, path_of, progress_of, shown, text, whole
from ._methods import Method
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
        self.warnings: list[str] = tell(parts["warnings"])

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


def bench(what: str | os.PathLike | Scenario, methods: str | Method | Sequence[Any] = (),
          conditions: Mapping[str, Any] | None = None, *, seeds: int | None = None, first_seed: int | None = None,
          phase_noise_rad: float | None = None, name: str | None = None, skip_missing: bool = False,
          allow_outside: bool = False, threads: int | None = None,
          progress: Callable[[float], Any] | None = None) -> Bench:
    """Compares methods on the same reads, by the same criteria and against the Cramér-Rao bound.

        tagfield.bench(scenario, ["hyperbola", mine], {"true pose": {}, "1 cm": {"pose.source": "noisy"}},
                       seeds=20)

    what: a scenario, the path of a scenario file, or the path of a suite file. A suite defines its own
        conditions and methods; only methods of your own can be added to them.
    methods: names, methods of your own, or (label, name or method, {setting: value}). Each needs a label of its
        own; by default it is the name. Where methods of your own have the same name, the column `method`
        numbers them.
    conditions: by label, the changes to the scenario (a mapping as for Scenario.with_()) or another
        Scenario.
    seeds: number of seeds per condition, 1 or more, by default 1 or the suite's.
    first_seed: the first of them, by default 1 or the suite's.
    phase_noise_rad: phase noise for the bound, 0 or more, where the model states none.
    name: title of the comparison.
    skip_missing, allow_outside: for files, see :func:`load`.
    progress: called now and then with the completed share, 0 to 1, and at the end with 1. Ctrl-C raises
        KeyboardInterrupt.
    """
    entries = _entries(methods)
    seeds = None if seeds is None else whole("bench: seeds", seeds, 1)
    first_seed = None if first_seed is None else whole("bench: first_seed", first_seed, 0, 2**64 - 1)
    if phase_noise_rad is not None:
        phase_noise_rad = number("bench: phase_noise_rad", phase_noise_rad, 0.0)
    name = None if name is None else text("bench: name", name)
    skip_missing = flag("bench: skip_missing", skip_missing)
    allow_outside = flag("bench: allow_outside", allow_outside)
    progress = progress_of("bench", progress)
    if not isinstance(what, Scenario):
        what = path_of("bench: what", what)
    if not isinstance(what, Scenario) and _is_suite(what):
        if conditions is not None or any(isinstance(method, str) for _, method, _ in entries):
            raise _core.Error("bench: a suite has its own conditions and methods: only your own methods can "
                              "be added")
        if phase_noise_rad is not None or name is not None:
            raise _core.Error("bench: a suite says phase_noise_rad and its name itself")
        own = [_renamed(method, name) for (_, method, _), name in
               zip(entries, _core_names([label for label, _, _ in entries]), strict=True)]
        return Bench(called("bench", _core.bench_suite, what, own, seeds, first_seed, skip_missing,
                            allow_outside, threads_of(threads), progress))
    if isinstance(what, Scenario) and (skip_missing or allow_outside):
        raise _core.Error("bench: skip_missing and allow_outside are of files: give them to tagfield.load()")
    scenario = what if isinstance(what, Scenario) else load(what, skip_missing=skip_missing,
                                                            allow_outside=allow_outside)
    if not entries:
        raise _core.Error("bench: methods is empty")
    if not isinstance(conditions, (Mapping, type(None))):
        raise _core.Error(f"bench: conditions is {shown(conditions)}, expected a mapping from label to changes")
    own = _own(entries)
    named = [(label, method if isinstance(method, str) else own[id(method)].name, settings)
             for label, method, settings in entries]
    made = [_condition(scenario, label, changes, phase_noise_rad)
            for label, changes in (conditions or {scenario.name: {}}).items()]
    return Bench(called("bench", _core.bench, name or "bench", named, made, list(own.values()),
                        1 if first_seed is None else first_seed, 1 if seeds is None else seeds,
                        threads_of(threads), progress))


def _is_suite(path: str) -> bool:
    """Whether the file is a suite: only suites have a key `conditions`."""
    try:
        lines = Path(path).read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return False  # load() says what is wrong.
    return any(line.startswith("conditions:") for line in lines)


def _entries(methods: Any) -> list[tuple[str, Any, list[tuple[str, str]]]]:
    """The methods as (label, name or own method, settings), with unique labels."""
    single = isinstance(methods, (str, _core.Method))
    if not single and not isinstance(methods, Iterable):
        raise _core.Error(f"bench: methods is {shown(methods)}, expected a list of methods")
    entries = [_entry(one) for one in ([methods] if single else methods)]
    labels = [label for label, _, _ in entries]
    for label in labels:
        if labels.count(label) > 1:
            raise _core.Error(f"bench: two methods are called '{label}': give them labels of their own, "
                              "(label, method, {})")
    return entries


def _entry(entry: Any) -> tuple[str, Any, list[tuple[str, str]]]:
    if isinstance(entry, _core.Method):
        return entry.name, entry, []
    if isinstance(entry, str):
        return entry, entry, []
    try:
        label, method, settings = entry
        pairs = [(f"localization.{key}", _value_text(value, f"bench: {key}")) for key, value in settings.items()]
    except (AttributeError, TypeError, ValueError) as error:
        if isinstance(error, _core.Error):
            raise
        raise _core.Error(f"bench: {shown(entry)} is no method, expected a name, a function decorated with "
                          "@tagfield.method(\"name\"), or (label, method, {setting: value})") from None
    if not isinstance(method, str):
        method_of("bench", method)
        if pairs:
            raise _core.Error(f"bench: '{label}' takes no settings, as it is a method of your own: use a closure")
    return str(label), method, pairs


def _own(entries: list[tuple[str, Any, Any]]) -> dict[int, _core.Method]:
    """Methods of one's own by identity, under names that the core can tell apart."""
    own = {id(method): method for _, method, _ in entries if not isinstance(method, str)}
    names = _core_names([method.name for method in own.values()])
    return {key: _renamed(method, name) for (key, method), name in zip(own.items(), names, strict=True)}


def _core_names(names: list[str]) -> list[str]:
    """Unique names that are no built-in method's, and text in a YAML list."""
    given: list[str] = []
    for name in names:
        plain = re.sub(r"[^\w.()-]+", " ", name).strip(" -.")
        plain = plain if plain.lower() not in ("", "none", "null") else "own"
        taken = {*given, *dict(_core.methods())}
        same = itertools.chain([plain], (f"{plain} {i}" for i in itertools.count(2)))
        given.append(next(one for one in same if one not in taken))
    return given


def _renamed(method: _core.Method, name: str) -> _core.Method:
    if method.name == name:
        return method
    if isinstance(method, Method):
        return method._named(name)
    raise _core.Error(f"bench: method '{method.name}' can't have this name here: make it by tagfield.method()")


def _condition(scenario: Scenario, label: str, changes: Any, noise: float | None) -> tuple:
    if isinstance(changes, Scenario):
        return label, changes._source.for_core(), [], noise
    if not isinstance(changes, Mapping):
        raise _core.Error(f"bench: condition '{label}' is {shown(changes)}, expected a mapping of changes or a "
                          "Scenario")
    pairs = [pair for key, value in changes.items() for pair in _flat("bench", key, value)]
    return label, scenario._source.for_core(), pairs, noise
