# SPDX-License-Identifier: Apache-2.0
"""Tables: structured NumPy arrays with names, in which results are returned."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, Iterable

import numpy as np

from . import _core
from ._checks import names as names_in
from ._checks import shown, suggestion
from ._warnings import tell

if TYPE_CHECKING:
    import pandas

__all__ = ["Table", "stack"]

_AXES = {3: ("x", "y", "z"), 4: ("x", "y", "z", "w")}


class Table(np.ndarray):
    """A NumPy structured array in which names are stored as indices.

    A table is an ordinary array: ``reads["phase_rad"]`` is a view of the column, slices and masks are
    tables again, and nothing is copied from the simulation. A column of names (``tag``,
    ``antenna``, ``reader``, ``verdict``, …) holds the index into ``categories[column]``;
    ``names(column)`` spells it out, and ``where(tag="tag3")`` selects by name.

    Units are in the columns' names. ``stamp_ns`` is exact; ``time_s`` is the same in seconds.

    ``driven_robot`` of believed poses names the robot that was driven while they were recorded, if any, as its
    poses are wheel odometry; :func:`localize` heeds it.
    """

    categories: dict[str, tuple[str, ...]]
    driven_robot: str

    def __new__(cls, array, categories=None):
        table = np.asarray(array).view(cls)
        table.categories = dict(categories or {})
        table.driven_robot = getattr(array, "driven_robot", "")
        return table

    def __array_finalize__(self, parent):
        self.categories = getattr(parent, "categories", {})
        self.driven_robot = getattr(parent, "driven_robot", "")

    def __array_function__(self, function, types, arguments, keywords):
        # NumPy would number the names of all tables as those of the first one are, or lose them.
        if function is np.concatenate and arguments[1:] in ((), (0,)) and keywords in ({}, {"axis": 0}):
            tables = list(arguments[0])
            if all(isinstance(table, Table) and table.ndim == 1 for table in tables):
                return stack(tables)
        return super().__array_function__(function, types, arguments, keywords)

    def __reduce__(self):
        function, arguments, state = super().__reduce__()
        return function, arguments, (state, self.categories, self.driven_robot)

    def __setstate__(self, state):
        super().__setstate__(state[0])
        self.categories = state[1]
        self.driven_robot = state[2] if len(state) > 2 else ""

    def __getitem__(self, index):
        item = super().__getitem__(index)
        if isinstance(item, Table) and item.dtype.names is None:
            return item.view(np.ndarray)  # A single column has no named fields.
        return item

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return self.dtype.names

    @property
    def time_s(self) -> np.ndarray:
        """``stamp_ns`` in seconds, float64 of the table's shape."""
        return self["stamp_ns"] * 1e-9

    def names(self, column: str) -> np.ndarray:
        """The names in a column, as an array of strings of the table's shape; "" where there is none."""
        known = np.array([*self._known(column), ""], dtype=object)
        return known[np.asarray(self[column])]

    def number(self, column: str, name: str) -> int:
        """The index that stands for ``name`` in a column, or -1 if the column does not have the name."""
        known = self._known(column)
        return known.index(name) if name in known else -1

    def where(self, **names: str | list[str] | tuple[str, ...]) -> Table:
        """Selects rows by names: ``reads.where(tag="tag3", antenna=["left", "right"])``.

        A name that the table does not have selects no rows, with a warning: it may be misspelt, or of
        something that does not appear yet.
        """
        rows = np.ones(self.shape, dtype=bool)
        for column, wanted in names.items():
            wanted = names_in(f"where: {column}", wanted)
            tell(f"where: {column}: the table has no '{name}'{suggestion(name, self._known(column))}"
                 for name in wanted if self.number(column, name) < 0)
            rows &= self._are(column, wanted)
        return self[rows]

    def _are(self, column: str, wanted: Iterable[str]) -> np.ndarray:
        """Boolean, of the table's shape: in which rows the column has one of these names."""
        numbers = [self.number(column, name) for name in wanted]
        return np.isin(self[column], [number for number in numbers if number >= 0])

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a pandas.DataFrame.

        Columns of names become categoricals; a position (3,) becomes three columns ``x_m``, ``y_m``,
        ``z_m`` (prefixed with the column's own name unless it is ``position_m``); matrices become
        columns with their indices; ``time_s`` is the first column if there are stamps.
        """
        import pandas

        flat = self.reshape(-1)
        data: dict[str, object] = {}
        if "stamp_ns" in self.columns:
            data["time_s"] = flat.time_s
        for column in self.columns:
            values = np.asarray(flat[column])
            if column in self.categories:
                data[column] = pandas.Categorical.from_codes(values, self.categories[column])
            elif values.ndim == 1:
                data[column] = values
            else:
                data.update(_split(column, values))
        return pandas.DataFrame(data)

    def _known(self, column: str) -> tuple[str, ...]:
        if column not in self.categories:
            raise KeyError(f"'{column}' is not a column of names; these are: {', '.join(self.categories)}")
        return self.categories[column]


def stack(tables: Iterable[Table]) -> Table:
    """The rows of several tables with the same columns, such as the reads of many runs, as one table.

        runs = scenario.run_many(100)
        reads = tagfield.stack([run.reads for run in runs])

    Names stay what they are: where tables number them differently, they are numbered anew, in the order in which they
    first come. ``numpy.concatenate`` of tables does the same. Which run a row is of can be told in pandas:

        pandas.concat({run.seed: run.reads.to_pandas() for run in runs}, names=["seed", "row"])

    Raises Error for an empty list, for what is no table, and for tables with different columns.
    """
    given = list(tables) if isinstance(tables, Iterable) and not isinstance(tables, np.ndarray) else [tables]
    for table in given:
        if not isinstance(table, Table):
            raise _core.Error(f"stack: {shown(table)} is no table, expected a list of tables")
        if table.dtype != given[0].dtype or set(table.categories) != set(given[0].categories):
            raise _core.Error(f"stack: a table has the columns {', '.join(table.columns)}, the first one "
                              f"{', '.join(given[0].columns)}")
    if not given:
        raise _core.Error("stack: there are no tables")
    # np.concatenate would drop the padding between the columns, which makes another type of table.
    stacked = np.zeros(sum(table.size for table in given), given[0].dtype)
    ends = np.cumsum([table.size for table in given])
    for table, end in zip(given, ends, strict=True):
        stacked[end - table.size:end] = np.asarray(table).reshape(-1)
    categories = {}
    for column in given[0].categories:
        known = tuple(dict.fromkeys(name for table in given for name in table.categories[column]))
        numbers = {name: number for number, name in enumerate(known)}
        # Without a name it is -1, which takes the last one.
        stacked[column] = np.concatenate([
            np.array([*(numbers[name] for name in table.categories[column]), -1])[np.asarray(table[column]).reshape(-1)]
            for table in given])
        categories[column] = known
    joined = Table(stacked, categories)
    joined.driven_robot = next((table.driven_robot for table in given if table.driven_robot), "")
    return joined


def _split(column: str, values: np.ndarray) -> dict[str, np.ndarray]:
    """Splits a column of vectors or matrices into several columns."""
    if values.ndim == 2 and values.shape[1] in _AXES:
        name, _, unit = column.rpartition("_")
        if column == "quaternion_xyzw":
            return {f"q{axis}": values[:, i] for i, axis in enumerate("xyzw")}
        before = "" if name == "position" else f"{name}_"
        axes = _AXES[values.shape[1]]
        if column.endswith("_m_s"):
            before, unit = f"{column[:-4]}_", "m_s"
        return {f"{before}{axis}_{unit}": values[:, i] for i, axis in enumerate(axes)}
    flat = values.reshape(len(values), -1)
    return {f"{column}_{'_'.join(map(str, index))}": flat[:, i]
            for i, index in enumerate(np.ndindex(*values.shape[1:]))}


def frame_of(csv: str) -> pandas.DataFrame:
    """Converts CSV text, as written by the command, to a pandas.DataFrame."""
    import pandas

    return pandas.read_csv(io.StringIO(csv), keep_default_na=False, na_values=[""])
