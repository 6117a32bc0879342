# SPDX-License-Identifier: Apache-2.0
"""Results of scenarios: runs, stepped simulations, tracks, coverage maps, explanations."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Mapping

import numpy as np

from . import _core
from ._checks import flag, number, shown, text, vector, whole
from ._tables import Table
from ._warnings import tell

if TYPE_CHECKING:
    from ._scenario import Scenario

__all__ = ["Coverage", "Explanation", "Layer", "Localization", "Run", "Scan", "Simulation", "Tracks", "Truth"]


_PATIENCE_S = 0.1


@dataclass(frozen=True)
class Truth:
    """Ground truth of a run, used only for evaluation, never for localization.

    antennas, robots: tables of stamp_ns, name, position_m (3,), quaternion_xyzw (4,); a fixed antenna
        has one row.
    tags: stamp_ns, tag, position_m (3,); one row whenever a tag appears or moves.
    distances: stamp_ns, antenna, tag, distance_m; one row per read, in the order of the reads.
    """

    antennas: Table
    robots: Table
    tags: Table
    distances: Table

    def positions_m(self) -> dict[str, np.ndarray]:
        """The last position (3,) [m, world] of each tag, by ID."""
        return {name: row["position_m"].copy()
                for name, row in zip(self.tags.names("tag"), self.tags, strict=True)}


class Localization:
    """Estimated positions of the tags.

    estimates: one row per tag: tag, verdict (located, ambiguous, not_located), reason, reads, reads_used,
        position_m (3,) [m, world] (NaN unless located), covariance_m2 (3, 3) (NaN where not stated),
        expected_error_m, rms_m of the best candidate, truth_m (3,) (NaN where unknown), error_m and
        horizontal_error_m (NaN where there is none), and reference (whether it is a reference tag, with a
        given position). expected_error_m is horizontal and is to be compared with horizontal_error_m;
        error_m is the distance in space, as in the command's tables.
    candidates: all candidate positions of the tags: tag, number (1 is best), position_m, covariance_m2,
        expected_error_m, rms_m.
    method: name of the method.
    why: why "auto" selected it.
    corrected_poses: antenna poses corrected for their estimated errors, by methods that estimate them.
    warnings: one line each.
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
        self.warnings = tell(parts["warnings"])
        self._text = parts["text"]

    @property
    def errors_m(self) -> np.ndarray:
        """(N,) errors [m]: distances between estimate and truth in space, of located tags with known truth."""
        errors = self.estimates["error_m"]
        return errors[np.isfinite(errors)]

    @property
    def horizontal_errors_m(self) -> np.ndarray:
        """(N,) the same distances seen from above [m], to compare with ``expected_error_m``."""
        errors = self.estimates["horizontal_error_m"]
        return errors[np.isfinite(errors)]

    @property
    def located(self) -> np.ndarray:
        """Boolean (N,): which rows of `estimates` are located; False for reference tags."""
        is_located = self.estimates["verdict"] == self.estimates.number("verdict", "located")
        return is_located & ~self.estimates["reference"]

    @property
    def located_of(self) -> str:
        """Number of located tags, without reference tags, as text: "9 of 10 tags located"."""
        return f"{int(self.located.sum())} of {int((~self.estimates['reference']).sum())} tags located"

    def __str__(self) -> str:
        return self._text


class Run(Localization):
    """A simulation run of a scenario with one seed, in memory.

    reads: stamp_ns, reader, antenna, tag, frequency_hz, phase_rad in [0, 2π), rssi_dbm, doppler_hz (NaN
        where it is not reported); one row per read, in order of time.
    poses: believed poses of the antennas: stamp_ns, name, position_m (3,) [m, world],
        quaternion_xyzw (4,), covariance (3, 3) of x, y, yaw (NaN where not stated); a fixed antenna has
        one row.
    truth: see :class:`Truth`.

    The attributes of :class:`Localization` hold the estimates.
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
        """Locates the tags from the same reads by another method; for keywords see :func:`localize`."""
        from ._reads import localize

        return localize(self.reads, self.poses, method, truth=self.truth.tags, scenario=self.scenario,
                        **keywords)


@dataclass(frozen=True)
class Scan:
    """One laser scan of a robot: ranges_m (N,) at first_angle_rad + i·angle_step_rad, counterclockwise.

    A range above max_range_m means no hit; 0 is an invalid beam.
    """

    stamp_s: float
    first_angle_rad: float
    angle_step_rad: float
    max_range_m: float
    ranges_m: np.ndarray


class Simulation:
    """A simulation that is run step by step, optionally with a robot that you drive.

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
        self._has_policy = policy is not None
        self._core = _core.Simulation(scenario._loaded, seed, outlets, robot,
                                      None if policy is None else _checked(policy))
        tell(self._core.warnings)
        self._taken: dict[str, Table] = self._core.take()

    def step(self, count: int = 1) -> Table:
        """Runs `count` time steps and returns their reads as a table, which may be empty.

        Ctrl-C raises KeyboardInterrupt between two steps; the reads until then are in the next table.
        """
        left = whole("step: count", count)
        at_once = 1
        while True:
            begin = time.monotonic()
            self._core.step(min(at_once, left))
            left -= min(at_once, left)
            if left == 0 or self.finished:
                break
            # As many as take about that long, since signals are only handled between calls.
            at_once = 2 * at_once if time.monotonic() - begin < _PATIENCE_S else max(at_once // 2, 1)
            at_once = min(at_once, 1_000_000)
        self._taken = self._core.take()
        return self._taken["reads"]

    def run_until(self, time_s: float) -> Table:
        """Steps to `time_s` or to the end, and returns the reads of these steps."""
        end_s = float(time_s) if time_s == math.inf else number("run_until: time_s", time_s)
        while self.now_s < end_s and not self.finished:
            self._core.step(1)
        self._taken = self._core.take()
        return self._taken["reads"]

    @property
    def poses(self) -> Table:
        """Believed poses of the antennas during the last step() or run_until(), as in Run.poses.

        Those on a driven robot are its wheel odometry, which :func:`localize` knows by their ``driven_robot``.
        """
        poses = self._taken["poses"]
        poses.driven_robot = self.robot
        return poses

    @property
    def truth(self) -> Truth:
        """Ground truth of the last step() or run_until()."""
        taken = self._taken
        return Truth(taken["true_antennas"], taken["true_robots"], taken["true_tags"], taken["true_distances"])

    def drive(self, forward_m_s: float, turn_rad_s: float) -> None:
        """Commands the robot's forward velocity and turn rate from now on; its limits apply.

        Not with a policy, which decides on them at each step.
        """
        if self._has_policy:
            raise _core.Error("drive: this robot is driven by its policy, expected a simulation without one")
        self._core.drive(number("drive: forward_m_s", forward_m_s), number("drive: turn_rad_s", turn_rad_s))

    @property
    def now_s(self) -> float:
        """Time at which the next step begins [s]."""
        return self._core.now_s

    @property
    def finished(self) -> bool:
        """Whether the scenario's duration is over or all robots have arrived."""
        return self._core.finished

    @property
    def odometry(self) -> np.ndarray:
        """Wheel odometry of the driven robot, (3,) x, y [m], yaw [rad] relative to its start pose."""
        return self._core.odometry

    @property
    def scan(self) -> Scan | None:
        """The driven robot's last laser scan, or None before the first one."""
        scan = self._core.scan
        return None if scan is None else Scan(*scan)

    def robot_pose(self, name: str = "", *, believed: bool = False) -> np.ndarray:
        """True or believed pose of a robot: (3,) x, y [m, world], yaw [rad]."""
        return self._core.robot_pose(text("robot_pose: name", name, "a name") or self.robot,
                                     flag("robot_pose: believed", believed))

    def add_tag(self, tag: str, position_m: Any, rpy_rad: Any = (0, 0, 0)) -> None:
        """Adds a tag at position_m (3,) [m, world], of the same model as the scenario's first tag.

        Raises Error for an ID that is empty or present, and for a position beyond 1e5 m.
        """
        if not isinstance(tag, str) or not tag:
            raise _core.Error(f"add_tag: tag is {shown(tag)}, expected an ID that is not empty")
        self._core.add_tag(tag, *_place("add_tag", position_m, rpy_rad))

    def move_tag(self, tag: str, position_m: Any, rpy_rad: Any = (0, 0, 0)) -> None:
        """Moves a tag to position_m (3,) [m, world], where it stays at rest."""
        self._core.move_tag(text("move_tag: tag", tag, "an ID"), *_place("move_tag", position_m, rpy_rad))

    def remove_tag(self, tag: str) -> None:
        """Removes a tag."""
        self._core.remove_tag(text("remove_tag: tag", tag, "an ID"))

    def has_tag(self, tag: str) -> bool:
        """Whether the tag is present."""
        return self._core.has_tag(text("has_tag: tag", tag, "an ID"))


def _place(what: str, position_m: Any, rpy_rad: Any) -> tuple[np.ndarray, np.ndarray]:
    return vector(f"{what}: position_m", position_m, most=1e5), vector(f"{what}: rpy_rad", rpy_rad)


def _checked(policy: Callable) -> Callable[[float], tuple[float, float]]:
    """The policy with a check of what it returns."""
    def asked(time_s: float) -> tuple[float, float]:
        action = policy(time_s)
        try:
            forward_m_s, turn_rad_s = (float(one) for one in action)
        except (TypeError, ValueError):
            raise _core.Error(f"policy: returned {shown(action)} at {time_s:g} s, expected two numbers: forward "
                              "velocity [m/s], turn rate [rad/s]") from None
        return forward_m_s, turn_rad_s

    return asked


class Explanation(dict):
    """Why a tag is read or not: the JSON of ``tagfield explain --json`` as a dict.

    str() returns the explanation as text.
    """

    def __init__(self, parts: Mapping[str, Any], text: str) -> None:
        super().__init__(parts)
        self._text = text

    @property
    def read(self) -> bool:
        """Whether the tag can be read."""
        return self["read"]

    @property
    def verdict(self) -> str:
        """The explanation in one line."""
        return self["verdict"]

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<tagfield.Explanation: {self.verdict}>"


@dataclass(frozen=True)
class Layer:
    """A coverage map at one height.

    height_m: the height [m, world].
    share_read: share of the cells in which a tag is read.
    cells: table of shape (rows, columns), with y increasing along rows and x along columns: power_dbm at
        the chip (with the paper's model the RSSI), reply_dbm, margin_db, probability, antenna. Levels are
        -400 where no signal arrives.
    """

    height_m: float
    share_read: float
    cells: Table


class Coverage:
    """Coverage maps: where a tag would be read.

    layers: a :class:`Layer` for each height.
    tags: the scenario's own tags: tag, verdict (never, seldom, intended, also_other, wrong), nearest
        (antenna), antenna (with the greatest margin), position_m (3,), nearest_m, power_dbm, reply_dbm, margin_db,
        probability. See docs/coverage.md.
    x_m, y_m: centres of the columns (columns,) and rows (rows,) [m, world].
    warnings: one line each.
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
        self.warnings: list[str] = tell(parts["warnings"])
        rows, columns = self.layers[0].cells.shape
        self.x_m = self.corner_m[0] + self.step_m * (np.arange(columns) + 0.5)
        self.y_m = self.corner_m[1] + self.step_m * (np.arange(rows) + 0.5)

    def __repr__(self) -> str:
        shares = ", ".join(f"{100 * layer.share_read:.1f} % at {layer.height_m:.2f} m"
                           for layer in self.layers)
        return f"<tagfield.Coverage {self.scenario.name}: read on {shares}>"


class Tracks:
    """Tracks of moving tags.

    tracks: one row per track, or per tag without a track: tag, verdict (tracked, ambiguous, not_tracked),
        reason, number (1 is best, 0 for none), reads, points, rms_rad, coherence, expected_error_m.
    points: stamp_ns, tag, number, position_m (3,) [m, world], velocity_m_s (3,), covariance (6, 6) of both.
    passings: stamp_ns, place ("line" or a fixed antenna), tag, sigma_s; at each place in the order of
        passing.
    warnings: one line each.
    """

    def __init__(self, parts: Mapping[str, Any]) -> None:
        self.tracks: Table = parts["tracks"]
        self.points: Table = parts["points"]
        self.passings: Table = parts["passings"]
        self.warnings: list[str] = tell(parts["warnings"])

    def order(self, place: str = "line") -> list[str]:
        """Tags in the order in which they passed the line or a fixed antenna."""
        return list(self.passings[self.passings._are("place", [place])].names("tag"))
