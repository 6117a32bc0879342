# SPDX-License-Identifier: Apache-2.0
"""Worlds and scenarios: from files, or made in Python."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable, Iterable, Mapping, Sequence

import numpy as np

from . import _core
from ._runs import Coverage, Explanation, Run, Simulation, Tracks
from ._warnings import tell

__all__ = ["Outlet", "Scenario", "World", "load", "share"]

_PACKAGE = Path(__file__).absolute().parent  # Links are not followed: the files lie beside them.


def share(name: str) -> str:
    """Path of a file that comes with Tagfield: ``share("scenarios/paper_warehouse.yaml")``.

    There are ``scenarios/``, ``worlds/`` and ``profiles/``. Raises Error where there is no such file.
    """
    path = _PACKAGE / "share" / name
    if path.exists():
        return str(path)
    raise _core.Error(f"share: Tagfield comes with no file '{name}'")


def threads_of(threads: int | None) -> int:
    """All of the machine's where None."""
    if threads is None:
        return os.cpu_count() or 1
    if not (isinstance(threads, int) and 1 <= threads <= 1024):
        raise _core.Error(f"threads is {threads!r}, expected 1 to 1024")
    return threads


class World:
    """Solids at rest, to simulate in: walls, shelves, people, a floor.

    Frames: W is the world, x and y level, z up [m]. ``rpy_rad`` turns about the fixed x, y, z axes in
    this order. ``material`` is one of ITU-R P.2040's (``concrete``, ``metal``, ``wood``, ``glass``, …) or
    of the scenario's own; without it, it is guessed from the name, with a warning. Only the physical
    models use the world.

        hall = tagfield.World()
        hall.box("wall", size_m=(10, 0.2, 4), position_m=(0, 3, 2), material="concrete")
    """

    def __init__(self) -> None:
        self._core = _core.World()
        self.materials: dict[str, str] = {}

    def box(self, name: str, size_m: Sequence[float], position_m: Sequence[float],
            rpy_rad: Sequence[float] = (0, 0, 0), material: str | None = None) -> World:
        """Adds a box with these edge lengths (3,) [m] about its middle at position_m (3,) [m, world]."""
        self._core.add_box(name, size_m, position_m, rpy_rad)
        return self._made_of(name, material)

    def cylinder(self, name: str, radius_m: float, length_m: float, position_m: Sequence[float],
                 rpy_rad: Sequence[float] = (0, 0, 0), material: str | None = None) -> World:
        """Adds a cylinder along its z axis about its middle."""
        self._core.add_cylinder(name, radius_m, length_m, position_m, rpy_rad)
        return self._made_of(name, material)

    def sphere(self, name: str, radius_m: float, position_m: Sequence[float],
               material: str | None = None) -> World:
        """Adds a sphere."""
        self._core.add_sphere(name, radius_m, position_m)
        return self._made_of(name, material)

    def floor(self, height_m: float = 0.0, name: str = "floor", material: str | None = "concrete") -> World:
        """Adds all that is below height_m."""
        self._core.add_floor(name, height_m)
        return self._made_of(name, material)

    def mesh(self, name: str, vertices_m: Any, triangles: Any, position_m: Sequence[float] = (0, 0, 0),
             rpy_rad: Sequence[float] = (0, 0, 0), material: str | None = None) -> World:
        """Adds triangles (M, 3) of indices into vertices_m (N, 3) [m]."""
        self._core.add_mesh(name, vertices_m, triangles, position_m, rpy_rad)
        return self._made_of(name, material)

    @property
    def solids(self) -> list[str]:
        """Names of all solids."""
        return self._core.solids

    def _made_of(self, name: str, material: str | None) -> World:
        if material is not None:
            self.materials[name] = material
        return self


class Outlet:
    """What an object may do to follow a run in progress; give it as ``outlets=[…]``.

    Any object with some of these methods will do, and so will a function, which gets each read. Stamps
    never fall. What a method raises ends the run and is raised there.
    """

    def on_read(self, read: _core.Read) -> None:
        """One read."""

    def on_update(self, antenna: str, stamp_s: float) -> None:
        """An antenna's update, after its reads."""

    def on_pose(self, pose: _core.Pose) -> None:
        """Where an antenna is believed to be, at its update."""

    def on_antenna_added(self, antenna: str) -> None:
        """An antenna is there from now on."""

    def on_antenna_removed(self, antenna: str) -> None:
        """An antenna is gone."""

    def on_tag_added(self, place: _core.Place) -> None:
        """The truth: a tag is there from now on."""

    def on_tag_moved(self, place: _core.Place) -> None:
        """The truth: a tag is elsewhere."""

    def on_tag_removed(self, tag: str) -> None:
        """The truth: a tag is gone."""

    def on_robot_pose(self, pose: _core.Pose) -> None:
        """The truth: where a robot is."""

    def on_antenna_pose(self, pose: _core.Pose) -> None:
        """The truth: where an antenna is."""

    def on_distance(self, stamp_s: float, antenna: str, tag: str, distance_m: float) -> None:
        """The truth: the distance [m] behind the read that comes next."""


@dataclass(frozen=True)
class _Source:
    """Where a scenario comes from, and what was changed in it."""

    path: str = ""
    text: str = ""
    name: str = ""
    world: World | None = None
    overrides: tuple[tuple[str, str], ...] = ()
    skip_missing: bool = False
    allow_outside: bool = False

    def load(self) -> _core.Loaded:
        if self.path:
            return _core.load(self.path, list(self.overrides), self.skip_missing, self.allow_outside)
        return _core.load_text(self.text, self.name, list(self.overrides),
                               None if self.world is None else self.world._core)

    def for_core(self) -> _core.ScenarioSource:
        return _core.ScenarioSource(self.path, self.text, self.name, list(self.overrides),
                                    None if self.world is None else self.world._core,
                                    self.skip_missing, self.allow_outside)


class Scenario:
    """What to simulate: robots, antennas, tags, a world. Never changes; ``with_()`` gives another.

    Made from a file by :func:`load`, or in Python with the keys of a scenario's file
    (docs/scenario.md), each a keyword:

        tagfield.Scenario(
            "portal", world=hall, duration_s=2, model="multipath",
            antennas=[{"name": "left", "pose": [0, 1, 1.5, 0, 0, -1.57]}],
            tags=[{"id": "tag1", "position": [0.5, 0, 1]}])

    Raises Error on a key or value that makes no sense; it names the key's path, and the line in
    :attr:`text`.
    """

    def __init__(self, name: str, *, world: World | str | Mapping[str, Any] | None = None,
                 **keys: Any) -> None:
        content: dict[str, Any] = {"name": name, **keys}
        made = world if isinstance(world, World) else None
        if made is not None and made.materials:
            content["world"] = {"materials": made.materials}
        elif isinstance(world, (str, os.PathLike)):
            content["world"] = {"path": os.fspath(world)}
        elif world is not None and made is None:
            content["world"] = dict(world)
        self._open(_Source(text=_text_of(content), name=name, world=made))

    @classmethod
    def _from(cls, source: _Source) -> Scenario:
        scenario = cls.__new__(cls)
        scenario._open(source)
        return scenario

    def _open(self, source: _Source) -> None:
        self._source = source
        self._loaded = source.load()
        tell(self._loaded.warnings)

    def __repr__(self) -> str:
        return (f"<tagfield.Scenario {self.name}: {len(self.antennas)} antennas, {len(self.tags)} tags, "
                f"{len(self.robots)} robots>")

    def with_(self, *changes: str | Mapping[str, Any], **keys: Any) -> Scenario:
        """The scenario with other values, as ``--set`` of the command has them:

            scenario.with_({"antennas.mobile.range_m": 5, "tags.tag1.appears_s": 3})
            scenario.with_("pose.source=noisy", seed=3, localization={"method": "sar"})

        Mappings in keywords are merged into what is there; lists replace.
        """
        more = _changes("with_", changes, keys)
        source = self._source
        return Scenario._from(replace(source, overrides=(*source.overrides, *more)))

    @property
    def name(self) -> str:
        """The scenario's name."""
        return self._loaded.name

    @property
    def text(self) -> str:
        """The scenario as it stood in its file, or as it was made here (YAML), without with_()."""
        if self._source.path:
            return Path(self._source.path).read_text(encoding="utf-8")
        return self._source.text

    @property
    def antennas(self) -> list[str]:
        """Names of the antennas."""
        return self._loaded.antennas

    @property
    def robots(self) -> list[str]:
        """Names of the robots."""
        return self._loaded.robots

    @property
    def tags(self) -> dict[str, np.ndarray]:
        """Where each tag truly begins: (3,) [m] by ID, in the world, or on the robot that carries it."""
        return self._loaded.tags

    @property
    def warnings(self) -> list[str]:
        """Warnings about it, which were told as :class:`TagfieldWarning` as it was read."""
        return self._loaded.warnings

    def outlines(self, low_m: float = 0.2, high_m: float = 2.0) -> list[tuple[str, list[np.ndarray]]]:
        """The world from above between two heights [m]: names, and rings of points (N, 2) [m]."""
        return [(name, [np.asarray(ring) for ring in rings])
                for name, rings in self._loaded.outlines(low_m, high_m)]

    def run(self, seed: int | None = None, *, method: _core.Method | str | None = None,
            locate: bool = True, outlets: Iterable[Outlet | Callable] = (), threads: int | None = None,
            progress: Callable[[float], Any] | None = None) -> Run:
        """Simulates, locates the tags and judges the estimates, in memory.

        seed: instead of the scenario's. The same seed gives the same bytes, whatever `threads`.
        method: instead of the scenario's, by name or one of your own (:func:`method`).
        locate: False for reads alone.
        outlets: what gets reads during the run; see :class:`Outlet`.
        progress: called with 0 … 1 now and then. Ctrl-C ends the run with KeyboardInterrupt.
        """
        scenario, own = self._by(method)
        seed = scenario._loaded.seed if seed is None else seed
        done = _core.run_seeds(scenario._loaded, [seed], threads_of(threads), locate, own, list(outlets),
                               progress)
        return Run(scenario, done[0])

    def run_many(self, seeds: int | Iterable[int], *, method: _core.Method | str | None = None,
                 locate: bool = True, threads: int | None = None,
                 progress: Callable[[float], Any] | None = None) -> list[Run]:
        """Many seeds in parallel, without Python's lock: ``run_many(100)`` runs 1 to 100."""
        scenario, own = self._by(method)
        wanted = list(range(1, seeds + 1)) if isinstance(seeds, int) else list(seeds)
        done = _core.run_seeds(scenario._loaded, wanted, threads_of(threads), locate, own, [], progress)
        return [Run(scenario, one) for one in done]

    def simulation(self, seed: int | None = None, *, robot: str = "",
                   policy: Callable[[float], tuple[float, float]] | None = None,
                   outlets: Iterable[Outlet | Callable] = ()) -> Simulation:
        """The scenario step by step: see :class:`Simulation`.

        robot: name of the one that you drive, by ``sim.drive(v, w)`` or by `policy`, a function of the
        time [s] that returns forward velocity [m/s] and turn rate [rad/s]. It believes its wheels
        (``navigation.odometry``), walls don't stop it, and it never arrives: give the scenario a
        ``duration_s``.
        """
        if policy is not None and not robot:
            raise _core.Error("simulation: a policy needs robot=NAME, whom it drives")
        return Simulation(self, self._loaded.seed if seed is None else seed, robot, policy, list(outlets))

    def explain(self, *, antenna: str = "", tag: str = "", time_s: float = 0.0,
                seed: int | None = None) -> Explanation:
        """Why an antenna reads a tag or not at a moment of the run; see docs/explain.md.

        antenna: by default the one whose link is the best.
        """
        text, spoken = _core.explain(self._loaded, antenna, tag, time_s,
                                     self._loaded.seed if seed is None else seed)
        return Explanation(json.loads(text), spoken)

    def coverage(self, *, antennas: Iterable[str] = (), heights_m: Iterable[float] = (),
                 step_m: float | None = None, region_m: Sequence[float] | None = None,
                 time_s: float | None = None, orientation: str | Sequence[float] = (0, 0, 0),
                 tag_profile: str = "", tag: Mapping[str, Any] | None = None, seed: int | None = None,
                 threads: int | None = None, progress: Callable[[float], Any] | None = None) -> Coverage:
        """Where a tag would be read, and which of the scenario's own are; see docs/coverage.md.

        heights_m: of the maps, by default the tags'. step_m: of a cell, by default 0.1 m or what takes
        some ten seconds. region_m: x0, y0, x1, y1, by default the whole world. time_s: that moment alone
        instead of the whole run. orientation: roll, pitch, yaw [rad] of the tag, or "any", "worst".
        tag: settings of the tag, as {"sensitivity_dbm": -20}.
        """
        asked = {
            "antennas": list(antennas), "heights_m": list(heights_m), "step_m": step_m, "time_s": time_s,
            "region": "" if region_m is None else ",".join(map(repr, map(float, region_m))),
            "orientation": orientation if isinstance(orientation, str)
            else ",".join(map(repr, map(float, orientation))),
            "tag_profile": os.fspath(tag_profile),
            "tag_settings": [f"{key}={_plain(value)}" for key, value in (tag or {}).items()],
            "seed": seed}
        return Coverage(self, _core.coverage(self._loaded, asked, threads_of(threads), progress))

    def link(self, *, antenna: str = "", tag: str = "", time_s: float = 0.0,
             tag_rpy_rad: Sequence[float] = (0, 0, 0)) -> _core.Link:
        """An antenna's links at a moment, without noise: ``link(x, y, z)``, ``link.batch(places)``.

        The tag is of the kind of `tag` (by default the first) and lies as `tag_rpy_rad` says. Moving
        bodies, other readers and neighbouring tags are left out.
        """
        return _core.link(self._loaded, antenna, tag, time_s, tag_rpy_rad)

    def track(self, seed: int | None = None, *, threads: int | None = None, **keywords: Any) -> Tracks:
        """Simulates, and follows the moving tags; keywords as of :func:`track`."""
        from ._reads import track

        run = self.run(seed, locate=False, threads=threads)
        return track(run.reads, run.poses, scenario=self, threads=threads, **keywords)

    def _by(self, method: _core.Method | str | None) -> tuple[Scenario, _core.Method | None]:
        """Who runs, and by which method of the user's own."""
        if isinstance(method, str):
            return self.with_({"localization.method": method}), None
        return self, method


def load(path: str | os.PathLike, *, skip_missing: bool = False, allow_outside: bool = False) -> Scenario:
    """Reads a scenario and its world from a YAML file. Raises Error "FILE:LINE: …".

    With ``skip_missing`` it goes on, with warnings, without models and meshes of the world that are
    missing or broken; with ``allow_outside`` the world may name files outside of its folder and the model paths.
    """
    return Scenario._from(_Source(path=os.fspath(path), skip_missing=skip_missing, allow_outside=allow_outside))


def _plain(value: Any) -> Any:
    """NumPy's numbers and arrays, and paths, as Python's."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"{type(value).__name__} can't be a value in a scenario")


def _dumped(value: Any, indent: int | None = None) -> str:
    try:
        return json.dumps(value, default=_plain, ensure_ascii=False, allow_nan=False, indent=indent)
    except (TypeError, ValueError) as error:
        raise _core.Error(f"scenario: {error}") from None


def _text_of(content: Mapping[str, Any]) -> str:
    """JSON, which is YAML: a line for each key, antenna, tag."""
    lines = []
    for key, value in content.items():
        if isinstance(value, (list, tuple)):
            rows = ",\n".join("    " + _dumped(row) for row in value)
            lines.append(f"  {_dumped(key)}: [\n{rows}\n  ]")
        else:
            lines.append(f"  {_dumped(key)}: {_dumped(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _value_text(value: Any) -> str:
    return value if isinstance(value, str) else _dumped(value)


def _changes(what: str, changes: Iterable[str | Mapping[str, Any]],
             keys: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Of with_() and its like, as the core takes them."""
    more: list[tuple[str, str]] = []
    for change in changes:
        if isinstance(change, str):
            key, equals, value = change.partition("=")
            if not (key and equals and value):
                raise _core.Error(f"{what}: '{change}': expected key.path=value")
            more.append((key, value))
        else:
            more += [(key, _value_text(value)) for key, value in change.items()]
    for key, value in keys.items():
        more += _flat(key, value)
    return more


def _flat(key: str, value: Any) -> list[tuple[str, str]]:
    """{"pose": {"sigma_m": 1}} as pose.sigma_m=1."""
    if isinstance(value, Mapping):
        return [pair for name, inner in value.items() for pair in _flat(f"{key}.{name}", inner)]
    return [(key, _value_text(value))]
