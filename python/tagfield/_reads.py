# SPDX-License-Identifier: Apache-2.0
"""Localization, tracking and calibration from reads of any source: files, readers or runs."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np

from . import _core
from ._runs import Localization, Tracks
from ._scenario import share, threads_of
from ._tables import Table
from ._warnings import tell

if TYPE_CHECKING:
    from ._scenario import Scenario

__all__ = ["Calibration", "calibrate", "localize", "methods", "poses_table", "read", "reads_table", "track"]


def methods() -> dict[str, str]:
    """The built-in localization methods: short descriptions by name."""
    return dict(_core.methods())


def read(reads: str | os.PathLike, poses: str | os.PathLike | None = None,
         format: str = "") -> tuple[Table, Table]:
    """Loads reads and antenna poses from files, as tables like Run.reads and Run.poses.

    reads: a CSV table, the folder of a run, an archive of tables, or a table in another `format`.
    poses: the antennas' poses (CSV), unless the run or the format includes them.
    format: format of third-party tables (docs/datasets.md): a name in profiles/datasets, such as
        "adarf", or the path of a YAML file.

    Raises Error "FILE:LINE: …".
    """
    form = format
    if form and not Path(form).suffix and os.sep not in form and not Path(form).exists():
        form = share(f"profiles/datasets/{form}.yaml")
    tables = _core.read(os.fspath(reads), "" if poses is None else os.fspath(poses), form)
    return tables["reads"], tables["poses"]


def reads_table(columns: Any) -> Table:
    """Makes a table of reads from a pandas.DataFrame or a mapping from column to array (N,).

    Required columns are time_s or stamp_ns, antenna, tag and phase_rad (increasing with distance).
    Optional ones are frequency_hz (default 866.5 MHz), rssi_dbm (default -60), reader and doppler_hz.
    """
    stamps = _stamps(columns, "reads")
    table = np.zeros(len(stamps), _core.read_dtype())
    table["stamp_ns"] = stamps
    defaults = {"frequency_hz": 866.5e6, "rssi_dbm": -60.0, "doppler_hz": np.nan}
    for column in ("phase_rad", "frequency_hz", "rssi_dbm", "doppler_hz"):
        table[column] = _numbers(columns, column, "reads", defaults.get(column))
    categories = {}
    for column in ("reader", "antenna", "tag"):
        names = columns[column] if column in columns else np.full(len(stamps), "reader")
        if column not in columns and column != "reader":
            raise _core.Error(f"reads: there is no column '{column}'")
        table[column], categories[column] = _numbered(names)
    return Table(table, categories)


def poses_table(columns: Any) -> Table:
    """Makes a table of antenna poses from a pandas.DataFrame or a mapping from column to array (N,).

    Required columns are time_s or stamp_ns, antenna (or name), x_m, y_m and z_m [m, world]. Optional
    ones are qx, qy, qz, qw (default: no rotation). A fixed antenna needs only one row.
    """
    stamps = _stamps(columns, "poses")
    table = np.zeros(len(stamps), _core.pose_dtype())
    table["stamp_ns"] = stamps
    names = columns["antenna"] if "antenna" in columns else columns["name"]
    table["name"], known = _numbered(names)
    for i, axis in enumerate("xyz"):
        table["position_m"][:, i] = _numbers(columns, f"{axis}_m", "poses")
    for i, axis in enumerate("xyzw"):
        table["quaternion_xyzw"][:, i] = _numbers(columns, f"q{axis}", "poses", float(axis == "w"))
    table["covariance"] = np.nan
    return Table(table, {"name": known})


def localize(reads: Any, poses: Any, method: _core.Method | str | None = None, *,
             settings: Mapping[str, Any] | None = None, truth: Any = None,
             scenario: Scenario | None = None, threads: int | None = None,
             **known: Any) -> Localization:
    """Locates the tags from reads and antenna poses, by any method.

    reads, poses: tables, pandas.DataFrames or mappings (:func:`reads_table`, :func:`poses_table`).
    method: a name in :func:`methods`, a method of your own, or None for the scenario's or else "auto",
        which selects a method by the data and states the reason.
    settings: settings of the method, such as {"stride_m": 1} (docs/methods.md).
    truth: true positions (3,) [m, world] by tag; used only to compute errors.
    scenario: scenario whose prior knowledge (heights, pose errors, world) applies where no keyword
        overrides it.

    Prior knowledge is given by keywords:

    tag_height_m: height of all tags [m, world].
    tag_heights_m: heights [m, world] by tag.
    height: "above" or "below": unknown heights are estimated, on that side of the antennas.
    side: side of the antennas' path on which tags can be: "left", "right" (of the motion), "+x", "-x",
        "+y" or "-y".
    box_m: x0, y0, x1, y1 [m, world] of the area in which tags can be.
    reference_tags: positions (3,) [m, world] of reference tags, by ID.
    offset_rad: phase offset of all antennas.
    offsets_rad: phase offsets by antenna.
    pose_sigma_m, pose_yaw_sigma_deg, pose_time_constant_s: standard deviations and correlation time of
        the pose error; the last two need pose_sigma_m.
    world_sigma_m: standard deviation of the position of the scenario world's surfaces [m], for method
        "multipath" (default 0.01; 0 for reads that were simulated in the same world).
    max_expected_error_m: a tag with a larger expected error is not located.
    pi_ambiguity: whether phases have the π ambiguity.
    """
    _refuse_unknown("localize", known, _KNOWN)
    own = method if isinstance(method, _core.Method) else None
    name = method.name if own is not None else method
    if name is None:
        name = "auto" if scenario is None else scenario._loaded.method
    pairs = [(key, value if isinstance(value, str) else _plain_text(value))
             for key, value in (settings or {}).items()]
    return Localization(_core.localize(
        _reads_argument(reads), _poses_argument(poses), _truth_argument(truth), name, own, pairs,
        None if scenario is None else scenario._loaded, _listed(known), threads_of(threads)))


def track(reads: Any, poses: Any, *, scenario: Scenario | None = None, threads: int | None = None,
          **known: Any) -> Tracks:
    """Tracks tags that move past antennas; see docs/tracking.md.

    Keywords, by default the scenario's values if there is a scenario:

    method: "ekf", "ukf" or "particle".
    lane: x, y [m], heading [deg] and optionally sigma [m] of the lane along which tags move.
    bidirectional: whether tags can move in both directions along the lane.
    line: x, y [m], heading [deg] of the line at which the order of passing is reported.
    speed_m_s: minimum and maximum speed.
    acceleration_noise: process noise in m/s²/√Hz; where phases demand more, more is tried, with doubled errors.
    tag_height_m, tag_heights_m, offset_rad, offsets_rad: see :func:`localize`.
    """
    _refuse_unknown("track", known, _TRACK)
    return Tracks(_core.track(_reads_argument(reads), _poses_argument(poses),
                              None if scenario is None else scenario._loaded, _listed(known),
                              threads_of(threads)))


@dataclass(frozen=True)
class Calibration:
    """Calibration of antennas from reads of tags at known positions.

    antennas: by name {"phase_sign", "phase_centre_m": 3 × (value, sigma, observable), "time_offset_s": (value,
        sigma, observable), "noise_rad", "reads", "offsets_rad": {frequency_hz: (value, sigma)}}; phase_centre_m
        is the phase centre's position in the antenna's believed frame.
    pi_ambiguity: whether the phases have the π ambiguity.
    yaml: the profile, for ``tagfield localize --calibration``.
    warnings: one line each.
    """

    antennas: dict[str, dict[str, Any]]
    pi_ambiguity: bool
    yaml: str
    warnings: list[str]

    def __post_init__(self) -> None:
        tell(self.warnings)

    def save(self, path: str | os.PathLike) -> None:
        """Writes the profile to a YAML file."""
        Path(path).write_text(self.yaml, encoding="utf-8")


def calibrate(reads: Any, poses: Any, tags: Mapping[str, Any], *, phase_centre_sigma_m: float = 0.1,
              time_sigma_s: float = 0.05, threads: int | None = None) -> Calibration:
    """Estimates phase centres, time offsets, phase offsets and phase noise of antennas.

    See docs/calibration.md.

    reads, poses: see :func:`localize`.
    tags: known positions (3,) [m, world] of the tags, by ID.
    phase_centre_sigma_m: prior standard deviation of the phase centre's position, per axis.
    time_sigma_s: prior standard deviation of the time offset.
    """
    places = {tag: np.asarray(place, dtype=float) for tag, place in tags.items()}
    return Calibration(**_core.calibrate(_reads_argument(reads), _poses_argument(poses), places,
                                         phase_centre_sigma_m, time_sigma_s, threads_of(threads)))


_HEIGHTS = {"tag_height_m", "tag_heights_m", "height", "offset_rad", "offsets_rad"}
_KNOWN = _HEIGHTS | {"side", "box_m", "reference_tags", "pose_sigma_m", "pose_yaw_sigma_deg",
                     "pose_time_constant_s", "world_sigma_m", "max_expected_error_m", "pi_ambiguity"}
_TRACK = _HEIGHTS - {"height"} | {"method", "lane", "bidirectional", "line", "speed_m_s", "acceleration_noise"}


def _refuse_unknown(function: str, given: Mapping[str, Any], known: set[str]) -> None:
    for key in given:
        if key not in known:
            raise TypeError(f"{function}() has no keyword '{key}'; these are: {', '.join(sorted(known))}")


def _listed(known: Mapping[str, Any]) -> dict[str, Any]:
    """The keywords with NumPy arrays as lists, and positions as arrays."""
    plain = {}
    for key, value in known.items():
        if key == "reference_tags" and value is not None:
            value = {tag: np.asarray(place, dtype=float) for tag, place in value.items()}
        elif isinstance(value, (np.ndarray, tuple)):
            value = np.asarray(value).tolist() if key != "speed_m_s" else tuple(value)
        plain[key] = value
    return plain


def _plain_text(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)


def _has_columns(data: Any) -> bool:
    return isinstance(data, Mapping) or type(data).__name__ == "DataFrame"


def _stamps(columns: Any, what: str) -> np.ndarray:
    if "stamp_ns" in columns:
        return np.asarray(columns["stamp_ns"], dtype=np.int64)
    for name in ("time_s", "stamp_s"):
        if name in columns:
            seconds = np.asarray(columns[name], dtype=float)
            if not np.isfinite(seconds).all() or (np.abs(seconds) > 4.6e9).any():
                raise _core.Error(f"{what}: {name} must be finite, and within 4.6e9 s")
            return np.round(seconds * 1e9).astype(np.int64)
    raise _core.Error(f"{what}: there is no column 'time_s' or 'stamp_ns'")


def _numbers(columns: Any, column: str, what: str, otherwise: float | None = None) -> Any:
    if column in columns:
        return np.asarray(columns[column], dtype=float)
    if otherwise is None:
        raise _core.Error(f"{what}: there is no column '{column}'")
    return otherwise


def _numbered(names: Any) -> tuple[np.ndarray, tuple[str, ...]]:
    known, numbers = np.unique(np.asarray(names, dtype=str), return_inverse=True)
    return numbers, tuple(known.tolist())


def _table_of(data: Any, dtype: np.dtype, what: str, make: Any) -> Table:
    if _has_columns(data):
        data = make(data)
    if not isinstance(data, Table) or data.dtype != dtype:
        raise _core.Error(f"{what}: expected a table as a run's, a DataFrame or a mapping of columns, got "
                          f"{type(data).__name__}")
    return Table(np.ascontiguousarray(data.reshape(-1)), data.categories)


def _reads_argument(reads: Any) -> _core.ReadsArgument:
    table = _table_of(reads, _core.read_dtype(), "reads", reads_table)
    names = table.categories
    return _core.ReadsArgument(table, names["reader"], names["antenna"], names["tag"])


def _poses_argument(poses: Any) -> _core.PosesArgument:
    table = _table_of(poses, _core.pose_dtype(), "poses", poses_table)
    return _core.PosesArgument(table, table.categories["name"])


def _truth_argument(truth: Any) -> _core.TruthArgument:
    if isinstance(truth, Table):
        return _core.TruthArgument(np.ascontiguousarray(truth), truth.categories["tag"])
    places = truth or {}
    table = np.zeros(len(places), _core.place_dtype())
    table["tag"] = np.arange(len(places))
    if places:
        table["position_m"] = [np.asarray(place, dtype=float) for place in places.values()]
    return _core.TruthArgument(table, list(places))
