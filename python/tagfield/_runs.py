# SPDX-License-Identifier: Apache-2.0
"""What comes of scenarios: runs, steps, tracks, maps, explanations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Mapping

import numpy as np

from . import _core
from ._tables import Table
from ._warnings import tell

if TYPE_CHECKING:
    from ._scenario import Scenario

__all__ = ["Coverage", "Explanation", "Layer", "Localization", "Run", "Scan", "Simulation", "Tracks", "Truth"]


@dataclass(frozen=True)
class Truth:
    """The ground truth: to judge by, never to locate by.

    antennas, robots: tables of stamp_ns, name, position_m (3,), quaternion_xyzw (4,); a fixed antenna
        has one row.
    tags: stamp_ns, tag, position_m (3,); a row whenever a tag comes or moves.
    distances: stamp_ns, antenna, tag, distance_m; a row a read, in the order of the reads.
    """

    antennas: Table
    robots: Table
    tags: Table
    distances: Table

    def places_m(self) -> dict[str, np.ndarray]:
        """The last position (3,) [m, world] of each tag, by ID."""
        return {name: row["position_m"].copy()
                for name, row in zip(self.tags.names("tag"), self.tags, strict=True)}


class Localization:
    """Estimates of the tags' positions.

    estimates: a row a tag: tag, verdict (located, ambiguous, not_located), reason, reads, reads_used,
        position_m (3,) [m, world] (NaN unless located), covariance_m2 (3, 3) (NaN where not stated),
        expected_error_m, rms_m of the best candidate, truth_m (3,) (NaN where unknown), error_m (NaN
        where there is none), and reference (a tag whose position was given).
    candidates: all positions that a tag may have: tag, number (1 is best), position_m, covariance_m2,
        expected_error_m, rms_m.
    method, why: by which method, and why "auto" chose it.
    corrected_poses: antenna poses with their error taken out, by methods that estimate it.
    warnings: what was odd, one line each.
    """

    estimates: Table
    candidates: Table
    corrected_poses: Table
    method: str
    why: str
    warnings: list[str]

    def __init__(self, parts: Mapping[str, Any]) -> None:
        self.estimates = parts["estimates"]
        self.candidates = parts["candidates"]
        self.corrected_poses = parts["corrected_poses"]
        self.method = parts["method"]
        self.why = parts["why"]
        self.warnings = parts["warnings"]
        tell(self.warnings)
        self._text = parts["text"]

    @property
    def errors_m(self) -> np.ndarray:
        """(N,) distances [m] between estimate and truth, of located tags with a known position."""
        errors = self.estimates["error_m"]
        return errors[np.isfinite(errors)]

    @property
    def located(self) -> np.ndarray:
        """Boolean (N,): which rows of `estimates` are located. Reference tags are not: theirs was given."""
        is_located = self.estimates["verdict"] == self.estimates.number("verdict", "located")
        return is_located & ~self.estimates["reference"]

    @property
    def located_of(self) -> str:
        """How many tags are located of those whose position was not given, as "9 of 10 tags located"."""
        return f"{int(self.located.sum())} of {int((~self.estimates['reference']).sum())} tags located"

    def __str__(self) -> str:
        return self._text


class Run(Localization):
    """One seed of a scenario, in memory.

    reads: stamp_ns, reader, antenna, tag, frequency_hz, phase_rad in [0, 2π), rssi_dbm, doppler_hz (NaN
        where it is not reported); a row a read, in order of time.
    poses: the antennas' poses as believed: stamp_ns, name, position_m (3,) [m, world],
        quaternion_xyzw (4,), covariance (3, 3) of x, y, yaw (NaN where not stated); a fixed antenna has
        one row.
    truth: see :class:`Truth`.
    And what :class:`Localization` has.
    """

    def __init__(self, scenario: Scenario, parts: Mapping[str, Any]) -> None:
        super().__init__(parts)
        self.scenario = scenario
        self.seed: int = parts["seed"]
        self.simulated_s: float = parts["simulated_s"]
        self.path_length_m: float = parts["path_length_m"]
        self.reads: Table = parts["reads"]
        self.poses: Table = parts["poses"]
        self.truth = Truth(parts["true_antennas"], parts["true_robots"], parts["true_tags"],
                           parts["true_distances"])

    def __repr__(self) -> str:
        return (f"<tagfield.Run {self.scenario.name}, seed {self.seed}: {len(self.reads)} reads in "
                f"{self.simulated_s:.1f} s, {self.located_of}>")

    def localize(self, method: Any = None, **keywords: Any) -> Localization:
        """The same reads by another method; keywords as of :func:`localize`."""
        from ._reads import localize

        return localize(self.reads, self.poses, method, truth=self.truth.tags, scenario=self.scenario,
                        **keywords)


@dataclass(frozen=True)
class Scan:
    """One scan of a robot's laser: ranges_m (N,) at first_angle_rad + i·angle_step_rad, to the left.

    A range over most_range_m hit nothing; 0 is invalid.
    """

    stamp_s: float
    first_angle_rad: float
    angle_step_rad: float
    most_range_m: float
    ranges_m: np.ndarray


class Simulation:
    """A scenario step by step, with a robot that you drive if you like.

        sim = scenario.simulation(robot="p3at")
        while not sim.finished:
            sim.drive(0.3, 0.1)
            reads = sim.step()

    Between steps tags can be added, moved and removed.
    """

    def __init__(self, scenario: Scenario, seed: int, robot: str, policy: Callable | None,
                 outlets: list) -> None:
        self.scenario = scenario
        self.robot = robot
        self._core = _core.Simulation(scenario._loaded, seed, outlets, robot, policy)
        self._told: dict[str, Table] = self._core.take()

    def step(self, count: int = 1) -> Table:
        """Runs `count` time steps and returns the reads that came, as a table (maybe without rows)."""
        self._core.step(count)
        self._told = self._core.take()
        return self._told["reads"]

    def run_until(self, time_s: float) -> Table:
        """Steps to `time_s`, or the end, and returns the reads that came."""
        while self.now_s < time_s and not self.finished:
            self._core.step(1)
        self._told = self._core.take()
        return self._told["reads"]

    @property
    def poses(self) -> Table:
        """The antennas' believed poses of the last step(), as Run.poses."""
        return self._told["poses"]

    @property
    def truth(self) -> Truth:
        """The truth of the last step()."""
        told = self._told
        return Truth(told["true_antennas"], told["true_robots"], told["true_tags"], told["true_distances"])

    def drive(self, forward_m_s: float, turn_rad_s: float) -> None:
        """The velocity that the robot is to have from now on, as far as its limits let it."""
        self._core.drive(forward_m_s, turn_rad_s)

    @property
    def now_s(self) -> float:
        """Time that the next step begins at [s]."""
        return self._core.now_s

    @property
    def finished(self) -> bool:
        """Whether the scenario's duration is over, or all robots have arrived."""
        return self._core.finished

    @property
    def odometry(self) -> np.ndarray:
        """(3,) x, y [m], yaw [rad] of the driven robot by its wheels, from where it started."""
        return self._core.odometry

    @property
    def scan(self) -> Scan | None:
        """The driven robot's last laser scan."""
        scan = self._core.scan
        return None if scan is None else Scan(*scan)

    def robot_pose(self, name: str = "", *, believed: bool = False) -> np.ndarray:
        """(3,) x, y [m, world], yaw [rad] of a robot: true, or as it believes."""
        return self._core.robot_pose(name or self.robot, believed)

    def add_tag(self, tag: str, position_m: Any, rpy_rad: Any = (0, 0, 0)) -> None:
        """Adds a tag now, of the first tag's kind, at position_m (3,) [m, world]."""
        self._core.add_tag(tag, position_m, rpy_rad)

    def move_tag(self, tag: str, position_m: Any, rpy_rad: Any = (0, 0, 0)) -> None:
        """The tag rests there from now on."""
        self._core.move_tag(tag, position_m, rpy_rad)

    def remove_tag(self, tag: str) -> None:
        """Takes a tag away."""
        self._core.remove_tag(tag)

    def has_tag(self, tag: str) -> bool:
        """Whether it is there."""
        return self._core.has_tag(tag)


class Explanation(dict):
    """Why a tag is read or not: the JSON of ``tagfield explain --json``, as a dict; str() is its text."""

    def __init__(self, parts: Mapping[str, Any], text: str) -> None:
        super().__init__(parts)
        self._text = text

    @property
    def read(self) -> bool:
        """Whether the tag can be read."""
        return self["read"]

    @property
    def verdict(self) -> str:
        """In one line."""
        return self["verdict"]

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<tagfield.Explanation: {self.verdict}>"


@dataclass(frozen=True)
class Layer:
    """A map at one height.

    cells: table of shape (rows, columns), y growing with rows, x with columns: power_dbm at the chip (by
        the paper's model the RSSI), reply_dbm, margin_db, probability, antenna. -400 where nothing
        arrives.
    share_read: share of the cells in which a tag is read.
    """

    height_m: float
    share_read: float
    cells: Table


class Coverage:
    """Where tags would be read.

    layers: a :class:`Layer` for each height.
    tags: the scenario's own: tag, verdict (never, intended, also_other, wrong), nearest, antenna (the
        best one), position_m (3,), nearest_m, power_dbm, reply_dbm, margin_db, probability.
    x_m, y_m: middles of the columns (columns,) and rows (rows,) [m, world].
    """

    def __init__(self, scenario: Scenario, parts: Mapping[str, Any]) -> None:
        self.scenario = scenario
        self.layers = [Layer(*layer) for layer in parts["layers"]]
        self.tags: Table = parts["tags"]
        self.step_m: float = parts["step_m"]
        self.corner_m: np.ndarray = parts["corner_m"]
        self.tag_kind: str = parts["tag_kind"]
        self.orientation: str = parts["orientation"]
        self.moment: str = parts["moment"]
        self.by_paper: bool = parts["by_paper"]
        self.warnings: list[str] = parts["warnings"]
        tell(self.warnings)
        rows, columns = self.layers[0].cells.shape
        self.x_m = self.corner_m[0] + self.step_m * (np.arange(columns) + 0.5)
        self.y_m = self.corner_m[1] + self.step_m * (np.arange(rows) + 0.5)

    def __repr__(self) -> str:
        shares = ", ".join(f"{100 * layer.share_read:.1f} % at {layer.height_m:.2f} m"
                           for layer in self.layers)
        return f"<tagfield.Coverage {self.scenario.name}: read on {shares}>"


class Tracks:
    """Tracks of moving tags.

    tracks: a row a track, or a tag that has none: tag, verdict (tracked, ambiguous, not_tracked), reason,
        number (1 is best, 0 for none), reads, points, rms_rad, coherence, expected_error_m.
    points: stamp_ns, tag, number, position_m (3,) [m, world], velocity_m_s (3,), covariance (6, 6) of both.
    passings: stamp_ns, place ("line", or an antenna at rest), tag, sigma_s; in the order of passing.
    """

    def __init__(self, parts: Mapping[str, Any]) -> None:
        self.tracks: Table = parts["tracks"]
        self.points: Table = parts["points"]
        self.passings: Table = parts["passings"]
        self.warnings: list[str] = parts["warnings"]
        tell(self.warnings)

    def order(self, place: str = "line") -> list[str]:
        """Tags in the order in which they passed a place."""
        return list(self.passings.where(place=place).names("tag"))
