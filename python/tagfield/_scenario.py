# SPDX-License-Identifier: Apache-2.0
"""Worlds and scenarios, loaded from files or created in Python."""

from __future__ import annotations

import copy
import json
import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable, Iterable, Mapping, Sequence

import numpy as np

from . import _core
from ._checks import (called, flag, function_of, mapping, method_of, names, number, path_of, progress_of, seed_of,
                      shown, text, time, vector, whole)
from ._runs import Coverage, Explanation, Run, Simulation, Tracks
from ._warnings import tell

__all__ = ["Outlet", "Scenario", "World", "load", "share"]

_PACKAGE = Path(__file__).absolute().parent  # Not resolve(): share/ is next to the symbolic links.


def share(name: str) -> str:
    """Path of a file included in Tagfield: ``share("scenarios/paper_warehouse.yaml")``.

    The folders are ``scenarios/``, ``worlds/`` and ``profiles/``. Raises Error if the file does not exist.
    """
    path = _PACKAGE / "share" / path_of("share: name", name)
    if path.exists():
        return str(path)
    raise _core.Error(f"share: Tagfield comes with no file '{name}'")


def threads_of(threads: int | None) -> int:
    """The checked number of threads; None stands for all CPUs."""
    return os.cpu_count() or 1 if threads is None else whole("threads", threads, 1, 1024)


class World:
    """A static world of solids to simulate in: walls, shelves, people, a floor.

    Coordinates are in the world frame W with x and y horizontal and z up [m]. ``rpy_rad`` (roll, pitch,
    yaw) rotates about the fixed x, y and z axes in this order. ``material`` is a material of ITU-R P.2040
    (``concrete``, ``metal``, ``wood``, ``glass``, …) or one defined in the scenario; without it, the
    material is guessed from the name, with a warning. Only the physical models use the world.

    A scenario keeps the world as it was when the scenario was created. Raises Error for a name that another
    solid has, a name with ``*``, which would be a pattern for the materials of other solids, and sizes that
    are not over 0 and at most 1e5 m.

        hall = tagfield.World()
        hall.box("wall", size_m=(10, 0.2, 4), position_m=(0, 3, 2), material="concrete")
    """

    def __init__(self) -> None:
        self._core = _Solids()
        self._is_kept = False
        self.materials: dict[str, str] = {}

    def __copy__(self) -> World:
        return copy.deepcopy(self)

    def box(self, name: str, size_m: Sequence[float], position_m: Sequence[float],
            rpy_rad: Sequence[float] = (0, 0, 0), material: str | None = None) -> World:
        """Adds a box with edge lengths size_m (3,) [m] and its centre at position_m (3,) [m, world]."""
        what = f"world: '{name}'"
        return self._add("add_box", name, material, vector(f"{what}: size_m", size_m),
                         vector(f"{what}: position_m", position_m), vector(f"{what}: rpy_rad", rpy_rad))

    def cylinder(self, name: str, radius_m: float, length_m: float, position_m: Sequence[float],
                 rpy_rad: Sequence[float] = (0, 0, 0), material: str | None = None) -> World:
        """Adds a cylinder along its own z axis, with its centre at position_m (3,) [m, world]."""
        what = f"world: '{name}'"
        return self._add("add_cylinder", name, material, number(f"{what}: radius_m", radius_m),
                         number(f"{what}: length_m", length_m), vector(f"{what}: position_m", position_m),
                         vector(f"{what}: rpy_rad", rpy_rad))

    def sphere(self, name: str, radius_m: float, position_m: Sequence[float],
               material: str | None = None) -> World:
        """Adds a sphere with its centre at position_m (3,) [m, world]."""
        what = f"world: '{name}'"
        return self._add("add_sphere", name, material, number(f"{what}: radius_m", radius_m),
                         vector(f"{what}: position_m", position_m))

    def floor(self, height_m: float = 0.0, name: str = "floor", material: str | None = "concrete") -> World:
        """Adds a floor that fills everything below height_m [m, world]."""
        return self._add("add_floor", name, material, number(f"world: '{name}': height_m", height_m))

    def mesh(self, name: str, vertices_m: Any, triangles: Any, position_m: Sequence[float] = (0, 0, 0),
             rpy_rad: Sequence[float] = (0, 0, 0), material: str | None = None) -> World:
        """Adds a triangle mesh: triangles (M, 3) are indices into vertices_m (N, 3) [m]."""
        what = f"world: '{name}'"
        corners = _numbers(f"{what}: triangles", triangles, "(M, 3) whole numbers")
        broken = corners[np.mod(corners, 1.0) != 0.0]
        if len(broken) > 0:
            raise _core.Error(f"{what}: triangles has {broken[0]}, expected whole numbers: indices into "
                              "vertices_m")
        return self._add("add_mesh", name, material, _numbers(f"{what}: vertices_m", vertices_m, "(N, 3) numbers"),
                         corners.astype(np.int64), vector(f"{what}: position_m", position_m),
                         vector(f"{what}: rpy_rad", rpy_rad))

    @property
    def solids(self) -> list[str]:
        """Names of all solids."""
        return self._core.solids

    def _add(self, function: str, name: str, material: str | None, *arguments: Any) -> World:
        if not isinstance(name, str) or "*" in name:
            raise _core.Error(f"world: the name of a solid is {shown(name)}, expected text without '*', which "
                              "stands for any characters where materials are given by name")
        if material is not None and not isinstance(material, str):
            raise _core.Error(f"world: '{name}': material is {shown(material)}, expected its name")
        if self._is_kept:
            self._core, self._is_kept = _solids(self._core.calls), False
        self._core.add(function, name, *arguments)
        if material is not None:
            self.materials[name] = material
        return self

    def _kept(self) -> _Solids:
        """The solids as they are now, for a scenario to keep: solids added later go into a copy."""
        self._is_kept = True
        return self._core


class _Solids(_core.World):
    """The core's world with the calls that make it, by which it is copied and pickled."""

    def __init__(self) -> None:
        super().__init__()
        self.calls: list[tuple[Any, ...]] = []

    def add(self, function: str, *arguments: Any) -> None:
        getattr(self, function)(*arguments)
        self.calls.append((function, *arguments))

    def __reduce__(self) -> tuple[Any, ...]:
        return _solids, (self.calls,)


def _solids(calls: Iterable[tuple[Any, ...]]) -> _Solids:
    made = _Solids()
    for call in calls:
        made.add(*call)
    return made


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
    world: _Solids | None = None
    overrides: tuple[tuple[str, str], ...] = ()
    skip_missing: bool = False
    allow_outside: bool = False

    def load(self, what: str) -> _core.Loaded:
        overrides = list(self.overrides)
        if self.path:
            return called(what, _core.load, self.path, overrides, self.skip_missing, self.allow_outside)
        return called(what, _core.load_text, self.text, self.name, overrides, self.world)

    def for_core(self) -> _core.ScenarioSource:
        return _core.ScenarioSource(self.path, self.text, self.name, list(self.overrides), self.world,
                                    self.skip_missing, self.allow_outside)

    def settled(self) -> _Source:
        """The same wherever the current folder is; paths in a text are relative to the folder of its name."""
        if self.path:
            return replace(self, path=os.path.abspath(self.path))
        return replace(self, name=os.path.join(os.getcwd(), self.name))


class Scenario:
    """What to simulate: robots, antennas, tags, a world. Immutable; ``with_()`` returns a changed copy.

    Loaded from a file by :func:`load`, or created in Python with the keys of a scenario file
    (docs/scenario.md) as keywords:

        tagfield.Scenario(
            "portal", world=hall, duration_s=2, model="multipath",
            antennas=[{"name": "left", "pose": [0, 1, 1.5, 0, 0, -1.57]}],
            tags=[{"id": "tag1", "position": [0.5, 0, 1]}])

    Raises Error for an invalid key or value, with the key's path and the line in :attr:`text`.

    Scenarios can be pickled, so that other processes run them. The file of a loaded one is read again there, under
    the same path, when it is first used.
    """

    def __init__(self, name: str, *, world: World | str | Mapping[str, Any] | None = None,
                 **keys: Any) -> None:
        if not isinstance(name, str):
            raise _core.Error(f"scenario: name is {shown(name)}, expected text")
        content: dict[str, Any] = {"name": name, **keys}
        made = world if isinstance(world, World) else None
        if not isinstance(world, (World, str, os.PathLike, Mapping, type(None))):
            raise _core.Error(f"scenario: world is {shown(world)}, expected a tagfield.World, a path or a mapping")
        if made is not None and made.materials:
            content["world"] = {"materials": made.materials}
        elif isinstance(world, (str, os.PathLike)):
            content["world"] = {"path": os.fspath(world)}
        elif world is not None and made is None:
            content["world"] = dict(world)
        self._open("scenario", _Source(text=_text_of(content), name=name,
                                       world=None if made is None else made._kept()))

    @classmethod
    def _from(cls, what: str, source: _Source) -> Scenario:
        scenario = cls.__new__(cls)
        scenario._open(what, source)
        return scenario

    def _open(self, what: str, source: _Source) -> None:
        self._opened: _core.Loaded | None = source.load(what)
        self._source = source.settled()
        self._warnings = tell(self._opened.warnings)

    @property
    def _loaded(self) -> _core.Loaded:
        if self._opened is None:  # It was pickled.
            self._opened = self._source.load("scenario")
        return self._opened

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_opened": None}

    def __copy__(self) -> Scenario:
        return self

    def __deepcopy__(self, memo: Any) -> Scenario:
        return self

    def __repr__(self) -> str:
        return (f"<tagfield.Scenario {self.name}: {len(self.antennas)} antennas, {len(self.tags)} tags, "
                f"{len(self.robots)} robots>")

    def with_(self, *changes: str | Mapping[str, Any], **keys: Any) -> Scenario:
        """A copy of the scenario with changed values, as by the command's option ``--set``:

            scenario.with_({"antennas.mobile.range_m": 5, "tags.tag1.appears_s": 3})
            scenario.with_("pose.source=noisy", seed=3, localization={"method": "sar"})

        Mappings in keywords are merged with the existing values; lists replace them.
        """
        return self._changed("with_", _changes("with_", changes, keys))

    def _changed(self, what: str, more: Iterable[tuple[str, str]]) -> Scenario:
        source = self._source
        return Scenario._from(what, replace(source, overrides=(*source.overrides, *more)))

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
        return self._warnings

    def outlines(self, low_m: float = 0.2, high_m: float = 2.0) -> list[tuple[str, list[np.ndarray]]]:
        """Outlines of the world between two heights [m], seen from above.

        Returns names with rings of points (N, 2) [m, world].
        """
        return [(name, [np.asarray(ring) for ring in rings])
                for name, rings in self._loaded.outlines(number("outlines: low_m", low_m),
                                                         number("outlines: high_m", high_m))]

    def run(self, seed: int | None = None, *, method: _core.Method | str | None = None,
            locate: bool = True, outlets: Iterable[Outlet | Callable] = (), threads: int | None = None,
            progress: Callable[[float], Any] | None = None) -> Run:
        """Simulates, locates the tags and evaluates the estimates, in memory.

        seed: instead of the scenario's. The same seed gives identical bytes for any number of threads.
        method: instead of the scenario's, a name or a method of your own (:func:`method`).
        locate: False to simulate reads without localization.
        outlets: receivers of reads during the run; see :class:`Outlet`.
        threads: number of threads, by default one per CPU.
        progress: called now and then with the completed share, 0 to 1, and at the end with 1. Ctrl-C ends the
            run with KeyboardInterrupt.
        """
        scenario, own = self._by("run", method)
        seed = scenario._loaded.seed if seed is None else seed_of("run", seed)
        done = _core.run_seeds(scenario._loaded, [seed], threads_of(threads), flag("run: locate", locate), own,
                               _outlets("run", outlets), progress_of("run", progress))
        return Run(scenario, done[0])

    def run_many(self, seeds: int | Iterable[int], *, method: _core.Method | str | None = None,
                 locate: bool = True, threads: int | None = None,
                 progress: Callable[[float], Any] | None = None) -> list[Run]:
        """Runs many seeds in parallel with the GIL released; ``run_many(100)`` runs seeds 1 to 100.

        For the other arguments see :meth:`run`.
        """
        scenario, own = self._by("run_many", method)
        if isinstance(seeds, Iterable):
            wanted = [seed_of("run_many", seed) for seed in seeds]
        else:
            wanted = list(range(1, whole("run_many: seeds", seeds, 1) + 1))
        if not wanted:
            raise _core.Error("run_many: seeds is empty, expected at least one seed")
        done = _core.run_seeds(scenario._loaded, wanted, threads_of(threads), flag("run_many: locate", locate), own,
                               [], progress_of("run_many", progress))
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
        robot = text("simulation: robot", robot, "a name")
        if policy is not None:
            policy = function_of("simulation: policy", policy, "of the time [s]")
        if policy is not None and not robot:
            raise _core.Error("simulation: a policy needs robot=NAME, whom it drives")
        seed = self._loaded.seed if seed is None else seed_of("simulation", seed)
        return Simulation(self, seed, robot, policy, _outlets("simulation", outlets))

    def explain(self, *, antenna: str = "", tag: str = "", time_s: float = 0.0,
                seed: int | None = None) -> Explanation:
        """Explains why an antenna reads a tag or not at one time of the run; see docs/explain.md.

        antenna: by default the one with the best link.
        """
        seed = self._loaded.seed if seed is None else seed_of("explain", seed)
        parts, spoken = called("explain", _core.explain, self._loaded, text("explain: antenna", antenna, "a name"),
                               text("explain: tag", tag, "an ID"), time("explain: time_s", time_s), seed)
        return Explanation(json.loads(parts), spoken)

    def coverage(self, *, antennas: str | Iterable[str] = (), heights_m: float | Iterable[float] = (),
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
        progress: called now and then with the completed share, 0 to 1, and at the end with 1.
        """
        heights = list(heights_m) if isinstance(heights_m, Iterable) else [heights_m]
        asked = {
            "antennas": names("coverage: antennas", antennas),
            "heights_m": [number("coverage: heights_m", height) for height in heights],
            "step_m": None if step_m is None else number("coverage: step_m", step_m, over=0.0),
            "time_s": None if time_s is None else time("coverage: time_s", time_s),
            "region": "" if region_m is None else _listed(vector("coverage: region_m", region_m, 4)),
            "orientation": orientation if isinstance(orientation, str)
            else _listed(vector("coverage: orientation", orientation)),
            "tag_profile": path_of("coverage: tag_profile", tag_profile),
            "tag_settings": [f"{key}={_value_text(value, f'coverage: tag: {key}')}"
                             for key, value in mapping("coverage: tag", tag, "setting to value").items()],
            "seed": None if seed is None else seed_of("coverage", seed)}
        return Coverage(self, called("coverage", _core.coverage, self._loaded, asked, threads_of(threads),
                                     progress_of("coverage", progress)))

    def link(self, *, antenna: str = "", tag: str = "", time_s: float = 0.0,
             tag_rpy_rad: Sequence[float] = (0, 0, 0)) -> _core.Link:
        """An antenna's link model at one time, without noise: ``link(x, y, z)``, ``link.batch(positions_m)``.

        The tag has the model of `tag` (by default the first) and the orientation `tag_rpy_rad` (roll,
        pitch, yaw). Moving bodies, other readers and neighbouring tags are not included.
        """
        return called("link", _core.link, self._loaded, text("link: antenna", antenna, "a name"),
                      text("link: tag", tag, "an ID"), time("link: time_s", time_s),
                      vector("link: tag_rpy_rad", tag_rpy_rad))

    def track(self, seed: int | None = None, *, threads: int | None = None, **keywords: Any) -> Tracks:
        """Simulates the scenario and tracks its moving tags; for keywords see :func:`track`."""
        from ._reads import track

        run = self.run(seed, locate=False, threads=threads)
        return track(run.reads, run.poses, scenario=self, threads=threads, **keywords)

    def _by(self, what: str, method: _core.Method | str | None) -> tuple[Scenario, _core.Method | None]:
        """The scenario to run, and the user's own method, if any."""
        if isinstance(method, str):
            return self._changed(what, [("localization.method", method)]), None
        return self, None if method is None else method_of(what, method)


def load(path: str | os.PathLike, *, skip_missing: bool = False, allow_outside: bool = False) -> Scenario:
    """Loads a scenario and its world from a YAML file. Raises Error "FILE:LINE: …".

    With ``skip_missing``, models and meshes of the world that are missing or broken are left out with a
    warning. With ``allow_outside``, the world may refer to files outside its folder and the model paths.
    """
    of_file = path_of("load: path", path)
    if not of_file:
        raise _core.Error("load: path is empty, expected a scenario file")
    return Scenario._from("load", _Source(path=of_file, skip_missing=flag("load: skip_missing", skip_missing),
                                          allow_outside=flag("load: allow_outside", allow_outside)))


def _outlets(what: str, outlets: Any) -> list[Any]:
    """The outlets as a list; one alone is none."""
    if isinstance(outlets, Iterable) and not isinstance(outlets, (str, bytes, Mapping)):
        return list(outlets)
    raise _core.Error(f"{what}: outlets is {shown(outlets)}, expected a list of outlets: outlets=[…]")


def _numbers(what: str, values: Any, expected: str) -> np.ndarray:
    """A copy of the values as floats."""
    try:
        return np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise _core.Error(f"{what} is {shown(values)}, expected {expected}") from None


def _listed(numbers: np.ndarray) -> str:
    return ",".join(map(repr, numbers.tolist()))


def _plain(value: Any) -> Any:
    """NumPy scalars and arrays, and paths, as plain Python values."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError


def _dumped(value: Any, key: str) -> str:
    """The value as JSON; `key` says in an Error where it stands."""
    try:
        return json.dumps(value, default=_plain, ensure_ascii=False, allow_nan=False)
    except (TypeError, ValueError) as error:
        for inner, part in _parts(value, key):
            _dumped(part, inner)  # Raises for the part that is wrong.
        expected = "a finite number" if isinstance(error, ValueError) else "a number, text, list or mapping"
        raise _core.Error(f"{key} is {shown(value)}, expected {expected}") from None


def _parts(value: Any, key: str) -> list[tuple[str, Any]]:
    if isinstance(value, Mapping):
        return [(f"{key}.{name}", part) for name, part in value.items()]
    if isinstance(value, (list, tuple)) or np.ndim(value) > 0:
        return [(f"{key}[{i}]", part) for i, part in enumerate(value)]
    return []


def _text_of(content: Mapping[str, Any]) -> str:
    """The content as JSON, which is valid YAML, with one line per key, antenna and tag."""
    lines = []
    for key, value in content.items():
        what = f"scenario: {key}"
        if isinstance(value, (list, tuple)):
            rows = ",\n".join("    " + _dumped(row, f"{what}[{i}]") for i, row in enumerate(value))
            lines.append(f"  {json.dumps(key)}: [\n{rows}\n  ]")
        else:
            lines.append(f"  {json.dumps(key)}: {_dumped(value, what)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _value_text(value: Any, key: str) -> str:
    return value if isinstance(value, str) else _dumped(value, key)


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
        elif isinstance(change, Mapping):
            more += [(str(key), _value_text(value, f"{what}: {key}")) for key, value in change.items()]
        else:
            raise _core.Error(f"{what}: {shown(change)} is no change, expected 'key.path=value' or a mapping")
    for key, value in keys.items():
        more += _flat(what, key, value)
    return more


def _flat(what: str, key: str, value: Any) -> list[tuple[str, str]]:
    """Flattens {"pose": {"sigma_m": 1}} to pose.sigma_m=1."""
    if isinstance(value, Mapping):
        return [pair for name, inner in value.items() for pair in _flat(what, f"{key}.{name}", inner)]
    return [(key, _value_text(value, f"{what}: {key}"))]
