# SPDX-License-Identifier: Apache-2.0
"""Worlds and scenarios, loaded from files or created in Python."""

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

_PACKAGE = Path(__file__).absolute().parent  # Not resolve(): share/ is next to the symbolic links.


def share(name: str) -> str:
    """Path of a file included in Tagfield: ``share("scenarios/paper_warehouse.yaml")``.

    The folders are ``scenarios/``, ``worlds/`` and ``profiles/``. Raises Error if the file does not exist.
    """
    path = _PACKAGE / "share" / name
    if path.exists():
        return str(path)
    raise _core.Error(f"share: Tagfield comes with no file '{name}'")


def threads_of(threads: int | None) -> int:
    """The checked number of threads; None stands for all CPUs."""
    if threads is None:
        return os.cpu_count() or 1
    if not (isinstance(threads, int) and 1 <= threads <= 1024):
        raise _core.Error(f"threads is {threads!r}, expected 1 to 1024")
    return threads


class World:
    """A static world of solids to simulate in: walls, shelves, people, a floor.

    Coordinates are in the world frame W with x and y horizontal and z up [m]. ``rpy_rad`` (roll, pitch,
    yaw) rotates about the fixed x, y and z axes in this order. ``material`` is a material of ITU-R P.2040
    (``concrete``, ``metal``, ``wood``, ``glass``, …) or one defined in the scenario; without it, the
    material is guessed from the name, with a warning. Only the physical models use the world.

        hall = tagfield.World()
        hall.box("wall", size_m=(10, 0.2, 4), position_m=(0, 3, 2), material="concrete")
    """

    def __init__(self) -> None:
        self._core = _core.World()
        self.materials: dict[str, str] = {}

    def box(self, name: str, size_m: Sequence[float], position_m: Sequence[float],
            rpy_rad: Sequence[float] = (0, 0, 0), material: str | None = None) -> World:
        """Adds a box with edge lengths size_m (3,) [m] and its centre at position_m (3,) [m, world]."""
        self._core.add_box(name, size_m, position_m, rpy_rad)
        return self._made_of(name, material)

    def cylinder(self, name: str, radius_m: float, length_m: float, position_m: Sequence[float],
                 rpy_rad: Sequence[float] = (0, 0, 0), material: str | None = None) -> World:
        """Adds a cylinder along its own z axis, with its centre at position_m (3,) [m, world]."""
        self._core.add_cylinder(name, radius_m, length_m, position_m, rpy_rad)
        return self._made_of(name, material)

    def sphere(self, name: str, radius_m: float, position_m: Sequence[float],
               material: str | None = None) -> World:
        """Adds a sphere with its centre at position_m (3,) [m, world]."""
        self._core.add_sphere(name, radius_m, position_m)
        return self._made_of(name, material)

    def floor(self, height_m: float = 0.0, name: str = "floor", material: str | None = "concrete") -> World:
        """Adds a floor that fills everything below height_m [m, world]."""
        self._core.add_floor(name, height_m)
        return self._made_of(name, material)

    def mesh(self, name: str, vertices_m: Any, triangles: Any, position_m: Sequence[float] = (0, 0, 0),
             rpy_rad: Sequence[float] = (0, 0, 0), material: str | None = None) -> World:
        """Adds a triangle mesh: triangles (M, 3) are indices into vertices_m (N, 3) [m]."""
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
    """Interface of objects that receive the data of a run in progress, passed as ``outlets=[…]``.

    Any object with some of these methods is an outlet, and so is a function, which receives each read.
    Stamps never decrease. An exception raised by a method ends the run and is raised by it.
    """

    def on_read(self, read: _core.Read) -> None:
        """A read."""

    def on_update(self, antenna: str, stamp_s: float) -> None:
        """An antenna's update is complete; its reads came before."""

    def on_pose(self, pose: _core.Pose) -> None:
        """An antenna's believed pose at its update."""

    def on_antenna_added(self, antenna: str) -> None:
        """An antenna was added."""

    def on_antenna_removed(self, antenna: str) -> None:
        """An antenna was removed."""

    def on_tag_added(self, place: _core.Place) -> None:
        """Ground truth: a tag was added."""

    def on_tag_moved(self, place: _core.Place) -> None:
        """Ground truth: a tag moved."""

    def on_tag_removed(self, tag: str) -> None:
        """Ground truth: a tag was removed."""

    def on_robot_pose(self, pose: _core.Pose) -> None:
        """Ground truth: a robot's pose."""

    def on_antenna_pose(self, pose: _core.Pose) -> None:
        """Ground truth: an antenna's pose."""

    def on_distance(self, stamp_s: float, antenna: str, tag: str, distance_m: float) -> None:
        """Ground truth: the distance [m] between antenna and tag for the read that follows."""


@dataclass(frozen=True)
class _Source:
    """Origin of a scenario, and the changes made to it."""

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
    """What to simulate: robots, antennas, tags, a world. Immutable; ``with_()`` returns a changed copy.

    Loaded from a file by :func:`load`, or created in Python with the keys of a scenario file
    (docs/scenario.md) as keywords:

        tagfield.Scenario(
            "portal", world=hall, duration_s=2, model="multipath",
            antennas=[{"name": "left", "pose": [0, 1, 1.5, 0, 0, -1.57]}],
            tags=[{"id": "tag1", "position": [0.5, 0, 1]}])

    Raises Error for an invalid key or value, with the key's path and the line in :attr:`text`.
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
        """A copy of the scenario with changed values, as by the command's option ``--set``:

            scenario.with_({"antennas.mobile.range_m": 5, "tags.tag1.appears_s": 3})
            scenario.with_("pose.source=noisy", seed=3, localization={"method": "sar"})

        Mappings in keywords are merged with the existing values; lists replace them.
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
        """The original scenario as YAML text, without the changes by with_()."""
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
        """True initial positions (3,) [m] by ID, in the world frame or that of the carrying robot."""
        return self._loaded.tags

    @property
    def warnings(self) -> list[str]:
        """Warnings about the scenario, which were issued as :class:`TagfieldWarning` on loading."""
        return self._loaded.warnings

    def outlines(self, low_m: float = 0.2, high_m: float = 2.0) -> list[tuple[str, list[np.ndarray]]]:
        """Outlines of the world between two heights [m], seen from above.

        Returns names with rings of points (N, 2) [m, world].
        """
        return [(name, [np.asarray(ring) for ring in rings])
                for name, rings in self._loaded.outlines(low_m, high_m)]

    def run(self, seed: int | None = None, *, method: _core.Method | str | None = None,
            locate: bool = True, outlets: Iterable[Outlet | Callable] = (), threads: int | None = None,
            progress: Callable[[float], Any] | None = None) -> Run:
        """Simulates, locates the tags and evaluates the estimates, in memory.

        seed: instead of the scenario's. The same seed gives identical bytes for any number of threads.
        method: instead of the scenario's, a name or a method of your own (:func:`method`).
        locate: False to simulate reads without localization.
        outlets: receivers of reads during the run; see :class:`Outlet`.
        threads: number of threads, by default one per CPU.
        progress: called now and then with the completed share, 0 to 1. Ctrl-C ends the run with
            KeyboardInterrupt.
        """
        scenario, own = self._by(method)
        seed = scenario._loaded.seed if seed is None else seed
        done = _core.run_seeds(scenario._loaded, [seed], threads_of(threads), locate, own, list(outlets),
                               progress)
        return Run(scenario, done[0])

    def run_many(self, seeds: int | Iterable[int], *, method: _core.Method | str | None = None,
                 locate: bool = True, threads: int | None = None,
                 progress: Callable[[float], Any] | None = None) -> list[Run]:
        """Runs many seeds in parallel with the GIL released; ``run_many(100)`` runs seeds 1 to 100.

        For the other arguments see :meth:`run`.
        """
        scenario, own = self._by(method)
        wanted = list(range(1, seeds + 1)) if isinstance(seeds, int) else list(seeds)
        done = _core.run_seeds(scenario._loaded, wanted, threads_of(threads), locate, own, [], progress)
        return [Run(scenario, one) for one in done]

    def simulation(self, seed: int | None = None, *, robot: str = "",
                   policy: Callable[[float], tuple[float, float]] | None = None,
                   outlets: Iterable[Outlet | Callable] = ()) -> Simulation:
        """A simulation to run step by step; see :class:`Simulation`.

        robot: name of the robot that you drive, by ``sim.drive(v, w)`` or by `policy`. Its believed pose
            is its wheel odometry (``navigation.odometry``). Walls do not stop it, and it never arrives:
            give the scenario a ``duration_s``.
        policy: function of the time [s] that returns forward velocity [m/s] and turn rate [rad/s].
        outlets: receivers of reads during the simulation; see :class:`Outlet`.
        """
        if policy is not None and not robot:
            raise _core.Error("simulation: a policy needs robot=NAME, whom it drives")
        return Simulation(self, self._loaded.seed if seed is None else seed, robot, policy, list(outlets))

    def explain(self, *, antenna: str = "", tag: str = "", time_s: float = 0.0,
                seed: int | None = None) -> Explanation:
        """Explains why an antenna reads a tag or not at one time of the run; see docs/explain.md.

        antenna: by default the one with the best link.
        """
        text, spoken = _core.explain(self._loaded, antenna, tag, time_s,
                                     self._loaded.seed if seed is None else seed)
        return Explanation(json.loads(text), spoken)

    def coverage(self, *, antennas: Iterable[str] = (), heights_m: Iterable[float] = (),
                 step_m: float | None = None, region_m: Sequence[float] | None = None,
                 time_s: float | None = None, orientation: str | Sequence[float] = (0, 0, 0),
                 tag_profile: str = "", tag: Mapping[str, Any] | None = None, seed: int | None = None,
                 threads: int | None = None, progress: Callable[[float], Any] | None = None) -> Coverage:
        """Maps where a tag would be read, and evaluates the scenario's own tags; see docs/coverage.md.

        antennas: names of antennas, by default all.
        heights_m: heights of the maps, by default those of the tags.
        step_m: cell size, by default 0.1 m, or larger so that it takes about ten seconds.
        region_m: x0, y0, x1, y1, by default the world with all antennas and tags.
        time_s: evaluates a single time instead of the complete run.
        orientation: roll, pitch, yaw [rad] of the tag, or "any" or "worst".
        tag_profile: file of the tag's profile, by default the first tag's.
        tag: settings of the tag, such as {"sensitivity_dbm": -20}.
        progress: called now and then with the completed share, 0 to 1.
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
        """An antenna's link model at one time, without noise: ``link(x, y, z)``, ``link.batch(positions_m)``.

        The tag has the model of `tag` (by default the first) and the orientation `tag_rpy_rad` (roll,
        pitch, yaw). Moving bodies, other readers and neighbouring tags are not included.
        """
        return _core.link(self._loaded, antenna, tag, time_s, tag_rpy_rad)

    def track(self, seed: int | None = None, *, threads: int | None = None, **keywords: Any) -> Tracks:
        """Simulates the scenario and tracks its moving tags; for keywords see :func:`track`."""
        from ._reads import track

        run = self.run(seed, locate=False, threads=threads)
        return track(run.reads, run.poses, scenario=self, threads=threads, **keywords)

    def _by(self, method: _core.Method | str | None) -> tuple[Scenario, _core.Method | None]:
        """The scenario to run, and the user's own method, if any."""
        if isinstance(method, str):
            return self.with_({"localization.method": method}), None
        return self, method


def load(path: str | os.PathLike, *, skip_missing: bool = False, allow_outside: bool = False) -> Scenario:
    """Loads a scenario and its world from a YAML file. Raises Error "FILE:LINE: …".

    With ``skip_missing``, models and meshes of the world that are missing or broken are left out with a
    warning. With ``allow_outside``, the world may refer to files outside its folder and the model paths.
    """
    return Scenario._from(_Source(path=os.fspath(path), skip_missing=skip_missing, allow_outside=allow_outside))


def _plain(value: Any) -> Any:
    """NumPy scalars and arrays, and paths, as plain Python values."""
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
    """The content as JSON, which is valid YAML, with one line per key, antenna and tag."""
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
    """Changes of with_() and similar functions, as pairs of key path and value for the core."""
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
    """Flattens {"pose": {"sigma_m": 1}} to pose.sigma_m=1."""
    if isinstance(value, Mapping):
        return [pair for name, inner in value.items() for pair in _flat(f"{key}.{name}", inner)]
    return [(key, _value_text(value))]
