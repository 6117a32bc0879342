# SPDX-License-Identifier: Apache-2.0
"""Checks of arguments; what is wrong is an Error of one line that names the argument."""

from __future__ import annotations

import difflib
import math
import operator
import os
import re
from typing import Any, Callable, Iterable, Mapping, Sequence

import numpy as np

from . import _core

__all__ = ["called", "flag", "function_of", "mapping", "method_of", "names", "number", "path_of", "progress_of",
           "seed_of", "shown", "spoken", "suggestion", "text", "time", "vector", "whole"]

_LATEST_S = 4.6e9  # Half of what 64 bits of nanoseconds can state.

# The command's options, and the arguments that they are here.
_ARGUMENTS = {
    "coverage: --antenna": "coverage: antennas", "coverage: --region": "coverage: region_m",
    "--allow-outside": "allow_outside=True", "--antenna NAME": "antenna=NAME", "--antenna": "antenna",
    "--box": "box_m", "--calibration": "offsets_rad", "--exact": "exact_s", "--format": "format",
    "--orientation": "orientation", "--poses FILE": "poses=FILE", "--poses": "poses",
    "--reference": "reference_tags", "--set world.path=FILE": "world=FILE", "--set": "with_",
    "--skip-missing": "skip_missing=True", "--tag NAME": "tag=NAME", "--tag-profile": "tag_profile",
    "--tag-set": "tag", "--tag": "tag",
}
_OPTION = re.compile("(?<![^\\s(])(" + "|".join(sorted(_ARGUMENTS, key=len, reverse=True)) + ")(?![\\w-])")


def shown(value: Any) -> str:
    """The value in one line that is not too long."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 80 else text[:77] + "..."


def whole(what: str, value: Any, least: int = 0, most: int = 2**63 - 1) -> int:
    """The value as an int from `least` to `most`; NumPy's integers are fine, floats are not."""
    limit = f"{least} or more" if most >= 2**63 - 1 else f"{least} to {most}"
    try:
        checked = operator.index(value)
    except TypeError:
        raise _core.Error(f"{what} is {shown(value)}, expected a whole number, {limit}") from None
    if least <= checked <= most:
        return checked
    limit = f"at most {most}" if checked > most >= 2**63 - 1 else limit
    raise _core.Error(f"{what} is {shown(value)}, expected {limit}")


def seed_of(what: str, value: Any) -> int:
    """The value as a seed of a run."""
    return whole(f"{what}: seed", value, 0, 2**64 - 1)


def number(what: str, value: Any, least: float = -math.inf, *, over: float | None = None) -> float:
    """The value as a finite float, at least `least`, or greater than `over`."""
    try:
        checked = math.nan if isinstance(value, (str, bytes)) else float(value)
    except (TypeError, ValueError):
        checked = math.nan
    if math.isfinite(checked) and checked >= least and (over is None or checked > over):
        return checked
    limit = f", over {over:g}" if over is not None else "" if least == -math.inf else f", {least:g} or more"
    raise _core.Error(f"{what} is {shown(value)}, expected a finite number{limit}")


def time(what: str, value: Any) -> float:
    """The value as a time of a run [s]."""
    if number(what, value, 0.0) <= _LATEST_S:
        return float(value)
    raise _core.Error(f"{what} is {shown(value)}, expected at most {_LATEST_S:g} s")


def vector(what: str, value: Any, size: int = 3, most: float = math.inf) -> np.ndarray:
    """The value as an array (size,) of finite numbers, none of them beyond ±most."""
    try:
        checked = np.array(value, dtype=float)
    except (TypeError, ValueError):
        checked = np.empty(0)
    if checked.shape == (size,) and np.isfinite(checked).all() and (np.abs(checked) <= most).all():
        return checked
    limit = "" if most == math.inf else f", up to ±{most:g}"
    raise _core.Error(f"{what} is {shown(value)}, expected {size} finite numbers{limit}")


def flag(what: str, value: Any) -> bool:
    """The value as a bool; words and other numbers than 0 and 1 are not."""
    if isinstance(value, (bool, np.bool_)) or (isinstance(value, (int, np.integer)) and value in (0, 1)):
        return bool(value)
    raise _core.Error(f"{what} is {shown(value)}, expected True or False")


def text(what: str, value: Any, expected: str = "text") -> str:
    """The value, which is a str."""
    if isinstance(value, str):
        return value
    raise _core.Error(f"{what} is {shown(value)}, expected {expected}")


def path_of(what: str, value: Any) -> str:
    """The value as the path of a file."""
    try:
        return os.fsdecode(value)
    except TypeError:
        raise _core.Error(f"{what} is {shown(value)}, expected a path") from None


def mapping(what: str, value: Any, content: str) -> Mapping[Any, Any]:
    """The value, a mapping; None is an empty one. `content`: "setting to value"."""
    if value is None:
        return {}
    if isinstance(value, Mapping):
        return value
    raise _core.Error(f"{what} is {shown(value)}, expected a mapping from {content}")


def function_of(what: str, value: Any, argument: str) -> Callable[..., Any]:
    """The value, which can be called."""
    if callable(value):
        return value
    raise _core.Error(f"{what} is {shown(value)}, expected a function {argument}")


def progress_of(what: str, value: Any) -> Callable[[float], Any] | None:
    """The value as a receiver of the completed share."""
    return None if value is None else function_of(f"{what}: progress", value, "of the completed share, 0 to 1")


def method_of(what: str, value: Any) -> _core.Method:
    """The value as a localization method of one's own."""
    if isinstance(value, _core.Method):
        return value
    raise _core.Error(f"{what}: method is {shown(value)}, expected a name or a function decorated with "
                      "@tagfield.method(\"name\")")


def names(what: str, value: Any) -> list[str]:
    """The value as a list of names; a str is one name."""
    listed = [value] if isinstance(value, str) else list(value) if isinstance(value, Iterable) else [value]
    for name in listed:
        if not isinstance(name, str):
            raise _core.Error(f"{what} is {shown(value)}, expected a name or a list of names")
    return listed


def suggestion(word: str, known: Sequence[str]) -> str:
    """The known word most like this one, or all if they are few, to append to a message."""
    near = difflib.get_close_matches(word, known, 1)
    if near:
        return f" (did you mean '{near[0]}'?)"
    return f" (known: {', '.join(known)})" if 0 < len(known) <= 20 else ""


def called(what: str, function: Callable, *arguments: Any) -> Any:
    """function(*arguments), whose errors name arguments of `what` instead of the command's options."""
    try:
        return function(*arguments)
    except _core.Error as error:
        said = spoken(re.sub("^--set:? ", f"{what}: ", str(error)))
        if said == str(error):
            raise
        raise _core.Error(said) from None


def spoken(message: str) -> str:
    """The message with arguments instead of the command's options."""
    return _OPTION.sub(lambda found: _ARGUMENTS[found[0]], message)
