# SPDX-License-Identifier: Apache-2.0
"""Localization, tracking and calibration from reads of any source: files, readers or runs."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np

from . import _core
from ._checks import called, mapping, method_of, number, path_of, shown, suggestion, vector
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
         format: str | os.PathLike = "") -> tuple[Table, Table]:
    """Loads reads and antenna poses from files, as tables like Run.reads and Run.poses.

    reads: a CSV table, the folder of a run, an archive of tables, or a table in another `format`.
    poses: the antennas' poses (CSV), unless the run or the format includes them.
    format: format of third-party tables (docs/datasets.md): a name in profiles/datasets, such as
        "adarf", or the path of a YAML file.

    Warns of carriers that can't be in Hz and of phases that are hardly in radians. Raises Error
    "FILE:LINE: …".
    """
    form = path_of("read: format", format)
    if form and not Path(form).suffix and os.sep not in form and not Path(form).exists():
        form = share(f"profiles/datasets/{form}.yaml")
    tables = called("read", _core.read, path_of("read: reads", reads),
                    "" if poses is None else path_of("read: poses", poses), form)
    tell(tables["warnings"])
    return tables["reads"], tables["poses"]


def reads_table(columns: Any) -> Table:
    """Makes a table of reads from a pandas.DataFrame or a mapping from column to array (N,).

    Required columns are time_s or stamp_ns, antenna, tag and phase_rad (increasing with distance).
    Optional ones are frequency_hz (default 866.5 MHz), rssi_dbm (default -60), reader and doppler_hz.
    Stamps may be datetime64 or timedelta64 of any unit. Other columns than the stamps may be one value for
    all rows. Raises Error for a column that is missing or of another length, and for a stamp or name that is
    missing.
    """
    stamps = _stamps(columns, "reads")
    table = np.zeros(len(stamps), _core.read_dtype())
    table["stamp_ns"] = stamps
    defaults = {"frequency_hz": 866.5e6, "rssi_dbm": -60.0, "doppler_hz": np.nan}
    for column in ("phase_rad", "frequency_hz", "rssi_dbm", "doppler_hz"):
        table[column] = _numbers(columns, column, "reads", len(stamps), defaults.get(column))
    categories = {}
    for column in ("reader", "antenna", "tag"):
        if column not in columns and column != "reader":
            raise _core.Error(f"reads: there is no column '{column}'")
        names = columns[column] if column in columns else "reader"
        table[column], categories[column] = _numbered(names, column, "reads", len(stamps))
    return Table(table, categories)


def poses_table(columns: Any) -> Table:
    """Makes a table of antenna poses from a pandas.DataFrame or a mapping from column to array (N,).

    Required columns are time_s or stamp_ns, antenna (or name), x_m, y_m and z_m [m, world]. Optional
    ones are qx, qy, qz, qw (default: no rotation). A fixed antenna needs only one row. For stamps and
    errors see :func:`reads_table`.
    """
    stamps = _stamps(columns, "poses")
    table = np.zeros(len(stamps), _core.pose_dtype())
    table["stamp_ns"] = stamps
    column = next((one for one in ("antenna", "name") if one in columns), None)
    if column is None:
        raise _core.Error("poses: there is no column 'antenna' or 'name'")
    table["name"], known = _numbered(columns[column], column, "poses", len(stamps))
    for i, axis in enumerate("xyz"):
        table["position_m"][:, i] = _numbers(columns, f"{axis}_m", "poses", len(stamps))
    for i, axis in enumerate("xyzw"):
        table["quaternion_xyzw"][:, i] = _numbers(columns, f"q{axis}", "poses", len(stamps), float(axis == "w"))
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
    vertical_side: "above" or "below": unknown heights are estimated, on that side of the antennas.
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
    driven_robot: name of the scenario's robot that was driven (:meth:`Scenario.simulation`), as its poses are
        wheel odometry, whose drift is then in the expected errors. Tables of a simulation's poses know it.
    max_expected_error_m: a tag with a larger expected error is not located.
    pi_ambiguity: whether phases have the π ambiguity.
    """
    _refuse_unknown("localize", known, _KNOWN)
    loaded = _loaded_of("localize", scenario)
    own = None if method is None or isinstance(method, str) else method_of("localize", method)
    name = method if own is None else own.name
    if name is None:
        name = "auto" if loaded is None else loaded.method
    pairs = [(key, value if isinstance(value, str) else _plain_text(value))
             for key, value in mapping("localize: settings", settings, "setting to value").items()]
    of_reads = _reads_table(reads)
    driven = getattr(poses, "driven_robot", "")
    if driven and loaded is not None:
        known.setdefault("driven_robot", driven)
    listed = _listed("localize", known)
    located = called("localize", _core.localize, _reads_argument(of_reads), _poses_argument(poses),
                     _truth_argument(truth), name, own, pairs, loaded, listed, threads_of(threads))
    unread = [warning for keyword in ("reference_tags", "tag_heights_m")
              for warning in _unread(keyword, listed.get(keyword) or {}, of_reads)]
    drifts = [_DRIFTS] if driven and loaded is None and "pose_sigma_m" not in known else []
    return Localization({**located, "warnings": [*unread, *drifts, *located["warnings"]]})


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
    return Tracks(called("track", _core.track, _reads_argument(_reads_table(reads)),
                         _poses_argument(poses), _loaded_of("track", scenario), _listed("track", known),
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
    return Calibration(**called("calibrate", _core.calibrate, _reads_argument(_reads_table(reads)),
                                _poses_argument(poses), _places("calibrate: tags", tags),
                                number("calibrate: phase_centre_sigma_m", phase_centre_sigma_m, 0.0),
                                number("calibrate: time_sigma_s", time_sigma_s, 0.0), threads_of(threads)))


_LATEST_NS = 2**63 - 1
_HEIGHTS = {"tag_height_m", "tag_heights_m", "vertical_side", "offset_rad", "offsets_rad"}
_DRIFTS = ("the poses are wheel odometry of a driven robot: what they are off by as a whole, since the start, is not "
           "in the expected errors (scenario=, the one that was driven, adds it)")
_KNOWN = _HEIGHTS | {"driven_robot", "side", "box_m", "reference_tags", "pose_sigma_m", "pose_yaw_sigma_deg",
                     "pose_time_constant_s", "world_sigma_m", "max_expected_error_m", "pi_ambiguity"}
_TRACK = _HEIGHTS - {"vertical_side"} | {"method", "lane", "bidirectional", "line", "speed_m_s", "acceleration_noise"}


def _refuse_unknown(function: str, given: Mapping[str, Any], known: set[str]) -> None:
    for key in given:
        if key == "height" and "vertical_side" in known:
            raise TypeError(f"{function}(): 'height' is now 'vertical_side', as --vertical-side of the command")
        if key not in known:
            raise TypeError(f"{function}() has no keyword '{key}'; these are: {', '.join(sorted(known))}")


def _places(what: str, places: Any) -> dict[str, np.ndarray]:
    """Positions (3,) by tag."""
    if not isinstance(places, Mapping):
        raise _core.Error(f"{what} is {shown(places)}, expected a mapping from tag to position (3,) [m, world]")
    return {str(tag): vector(f"{what}: '{tag}'", place) for tag, place in places.items()}


def _loaded_of(function: str, scenario: Any) -> _core.Loaded | None:
    if scenario is None:
        return None
    if not hasattr(scenario, "_loaded"):
        raise _core.Error(f"{function}: scenario is {shown(scenario)}, expected a tagfield.Scenario")
    return scenario._loaded


def _unread(keyword: str, by_tag: Mapping[str, Any], reads: Table) -> list[str]:
    """Warnings about tags of a keyword that were not read."""
    known = reads.categories["tag"]
    return [f"localize: {keyword}: there are no reads of tag '{tag}'{suggestion(tag, known)}"
            for tag in by_tag if not reads._are("tag", [tag]).any()]


def _listed(function: str, known: Mapping[str, Any]) -> dict[str, Any]:
    """The keywords with NumPy arrays as lists, and positions as arrays."""
    plain = {}
    for key, value in known.items():
        if key == "reference_tags" and value is not None:
            value = _places(f"{function}: reference_tags", value)
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
    name = next((one for one in ("stamp_ns", "time_s", "stamp_s") if one in columns), None)
    if name is None:
        raise _core.Error(f"{what}: there is no column 'time_s' or 'stamp_ns'")
    values = _dated(columns[name])
    if values.ndim != 1:
        raise _core.Error(f"{what}: {name} has shape {values.shape}, expected (N,)")
    if values.dtype.kind in "mM":
        return _nanoseconds(values, f"{what}: {name}")
    if name == "stamp_ns" and values.dtype.kind in "iu" and (values <= _LATEST_NS).all():
        return values.astype(np.int64)
    stamps_ns = _floats(values, f"{what}: {name}") * (1.0 if name == "stamp_ns" else 1e9)
    if not np.isfinite(stamps_ns).all() or (np.abs(stamps_ns) > 4.6e18).any():
        raise _core.Error(f"{what}: {name} must be finite, and within 4.6e9 s")
    return np.round(stamps_ns).astype(np.int64)


def _dated(values: Any) -> np.ndarray:
    """The values as an array; dates and times of pandas with a time zone become UTC."""
    array = np.asarray(values)
    if array.dtype.kind == "O" and array.size > 0 and hasattr(array.flat[0], "tzinfo"):
        return np.asarray(values, dtype="datetime64[ns]")
    return array


def _nanoseconds(values: np.ndarray, what: str) -> np.ndarray:
    """datetime64 or timedelta64 of any unit in nanoseconds."""
    if np.isnat(values).any():
        raise _core.Error(f"{what}: row {np.isnat(values).argmax()} has no time")
    kind = values.dtype.kind
    try:
        seconds = values.astype(f"{kind}8[s]").astype(np.int64)
    except TypeError:
        raise _core.Error(f"{what} is of type {values.dtype}, which is no fixed time") from None
    if (np.abs(seconds) > 4.6e9).any():
        raise _core.Error(f"{what} must be within 4.6e9 s")
    return values.astype(f"{kind}8[ns]").astype(np.int64)


def _floats(values: Any, what: str) -> np.ndarray:
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise _core.Error(f"{what} is {shown(values)}, expected numbers") from None


def _numbers(columns: Any, column: str, what: str, rows: int, otherwise: float | None = None) -> Any:
    if column in columns:
        values = _floats(columns[column], f"{what}: {column}")
        _require_rows(values, f"{what}: {column}", rows)
        return values
    if otherwise is None:
        raise _core.Error(f"{what}: there is no column '{column}'")
    return otherwise


def _numbered(names: Any, column: str, what: str, rows: int) -> tuple[np.ndarray, tuple[str, ...]]:
    """The names in a column as numbers, and the names by number."""
    values = np.asarray(names) if hasattr(names, "dtype") else np.asarray(names, dtype=object)
    _require_rows(values, f"{what}: {column}", rows)
    if values.dtype.kind in "fO":
        for row, value in enumerate(values.flat):
            if value is None or type(value).__name__ == "NAType" or value != value:
                raise _core.Error(f"{what}: {column}: row {row} is {value}, expected a name")
    known, numbers = np.unique(values.astype(str), return_inverse=True)
    return numbers.reshape(values.shape), tuple(known.tolist())


def _require_rows(values: np.ndarray, what: str, rows: int) -> None:
    """One value for each row, or one for all of them."""
    if values.ndim == 0 or values.shape == (rows,):
        return
    has = f"{len(values)} rows" if values.ndim == 1 else f"shape {values.shape}"
    raise _core.Error(f"{what} has {has}, but there are {rows} stamps")


def _table_of(data: Any, dtype: np.dtype, what: str, make: Any) -> Table:
    if _has_columns(data):
        data = make(data)
    if not isinstance(data, Table) or data.dtype != dtype:
        raise _core.Error(f"{what}: expected a table as a run's, a DataFrame or a mapping of columns, got "
                          f"{type(data).__name__}")
    return Table(np.ascontiguousarray(data.reshape(-1)), data.categories)


def _reads_table(reads: Any) -> Table:
    return _table_of(reads, _core.read_dtype(), "reads", reads_table)


def _reads_argument(table: Table) -> _core.ReadsArgument:
    names = table.categories
    return _core.ReadsArgument(table, names["reader"], names["antenna"], names["tag"])


def _poses_argument(poses: Any) -> _core.PosesArgument:
    table = _table_of(poses, _core.pose_dtype(), "poses", poses_table)
    return _core.PosesArgument(table, table.categories["name"])


def _truth_argument(truth: Any) -> _core.TruthArgument:
    if isinstance(truth, Table):
        return _core.TruthArgument(np.ascontiguousarray(truth), truth.categories["tag"])
    places = {} if truth is None else _places("truth", truth)
    table = np.zeros(len(places), _core.place_dtype())
    table["tag"] = np.arange(len(places))
    if places:
        table["position_m"] = list(places.values())
    return _core.TruthArgument(table, list(places))
