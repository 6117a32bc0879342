# SPDX-License-Identifier: Apache-2.0
"""Localization methods written in Python."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Callable, Mapping

import numpy as np

from . import _core
from ._checks import number, shown

__all__ = ["Estimate", "Method", "Problem", "method"]

Problem = _core.Problem


class Method(_core.Method):
    """A localization method of your own, as tagfield.method() makes one."""

    def __init__(self, name: str, summary: str, function: Callable[[Problem], list[tuple]]) -> None:
        super().__init__(name, summary, function)
        self._function = function

    def _named(self, name: str) -> Method:
        """The same method under another name."""
        return Method(name, self.summary, self._function)


@dataclass
class Estimate:
    """A position estimate of a tag, as returned by a method of your own.

    position_m: x, y [m, world], or x, y, z; without z, the height is :meth:`Problem.height_m`.
    covariance_m2: covariance of the position [m²], (3, 3) or (2, 2), if the method knows it; symmetric,
        without negative eigenvalues.
    expected_error_m: square root of the trace of the horizontal covariance [m]; by default, and if
        it is 0, computed from covariance_m2; 0 without one claims that there is no error. If it exceeds
        the limit (0.15 m by default), the tag does not count as located.
    rms_m: root mean square of the fit's residuals [m].
    """

    position_m: Any
    covariance_m2: Any = None
    expected_error_m: float | None = None
    rms_m: float = 0.0


def method(name: str, summary: str = "", *, per_tag: bool = True) -> Callable[[Callable], Method]:
    """Decorator that makes a function a localization method, to run and compare like any other.

    With ``per_tag``, the function is called for each tag as ``function(problem, tag, samples)``, with
    ``samples = problem.samples(tag)``, and returns one of:

    - a position: two or three numbers [m, world], or an :class:`Estimate`;
    - a list of positions, best first: the tag is ambiguous;
    - ``None``, or the reason as a string: the tag is not located.

    Without ``per_tag``, it is called once as ``function(problem)`` and returns a mapping from tag to
    one of these.

    The position is not checked against the phases, as those of built-in methods are. As with any method,
    a tag is not located if its expected error or rms_m exceeds the limit (0.08 m for rms_m), if its position
    lies outside the area where tags can be, or if its reads are those of several tags or of a tag that moved.
    Positions over 1 km from where the tag was read are left out with a warning; what is no position of two or
    three finite numbers raises Error.
    In a bench, several threads call the function, but never at the same time.

    Raises Error for the name of a built-in method.

        @tagfield.method("strongest", "where the RSSI was highest")
        def strongest(problem, tag, samples):
            return samples["position_m"][samples["rssi_dbm"].argmax(), :2]
    """

    def decorate(function: Callable) -> Method:
        def locate(problem):
            if per_tag:
                answers = {}
                for tag in problem.tags:
                    answers[tag] = function(problem, tag, problem.samples(tag))
                    problem._report(len(answers) / len(problem.tags))
            else:
                answers = function(problem)
            return _answers(name, problem, answers)

        return Method(name, summary or (function.__doc__ or "").strip().split("\n")[0], locate)

    if not isinstance(name, str) or not name:
        raise _core.Error("a method needs a name: @tagfield.method(\"name\")")
    if name == "none" or name in dict(_core.methods()):
        raise _core.Error(f"method: name is '{name}', which Tagfield uses itself: give another")
    return decorate


def _answers(name: str, problem: Problem, answers: Mapping[str, Any]) -> list[tuple]:
    """The answers in the form that the core expects: (tag, reason for failure, positions) per tag."""
    tags = problem.tags
    if not isinstance(answers, Mapping):
        raise _core.Error(f"method '{name}': returned {type(answers).__name__}, expected a mapping "
                          "from tag to position")
    for tag in answers:
        if tag not in tags:
            raise _core.Error(f"method '{name}': the problem has no tag '{tag}'")
    found = []
    for tag in tags:
        answer = answers.get(tag)
        if answer is None or isinstance(answer, str):
            found.append((tag, answer or f"{name} found no position", []))
        else:
            found.append((tag, "", [_place(name, problem, tag, one) for one in _several(answer)]))
    return found


def _several(answer: Any) -> list:
    """The answer as a list of positions."""
    if isinstance(answer, (list, tuple)) and answer and not np.isscalar(answer[0]):
        return list(answer)
    return [answer]


def _place(name: str, problem: Problem, tag: str, answer: Any) -> tuple:
    estimate = answer if isinstance(answer, Estimate) else Estimate(answer)
    try:
        place = np.asarray(estimate.position_m, dtype=float)
    except (TypeError, ValueError):
        place = np.empty(0)
    if place.shape not in ((2,), (3,)) or not np.isfinite(place).all():
        raise _core.Error(f"method '{name}': tag '{tag}': {shown(estimate.position_m)} is not a position: "
                          "expected two or three finite numbers [m]")
    if len(place) == 2:
        place = np.append(place, problem.height_m(tag))
    covariance = None
    if estimate.covariance_m2 is not None:
        try:
            given = np.asarray(estimate.covariance_m2, dtype=float)
        except (TypeError, ValueError):
            given = np.empty(0)
        if given.shape not in ((2, 2), (3, 3)) or not np.isfinite(given).all():
            raise _core.Error(f"method '{name}': tag '{tag}': covariance_m2 must be (2, 2) or (3, 3) and "
                              "finite")
        if not _is_covariance(given):
            raise _core.Error(f"method '{name}': tag '{tag}': covariance_m2 is {shown(given.tolist())}, expected a "
                              "symmetric matrix without negative eigenvalues")
        covariance = np.zeros((3, 3))
        covariance[:len(given), :len(given)] = given
    expected = estimate.expected_error_m
    for key, value in (("expected_error_m", 0.0 if expected is None else expected), ("rms_m", estimate.rms_m)):
        number(f"method '{name}': tag '{tag}': {key}", value, 0.0)
    if covariance is None and expected is not None and expected == 0.0:
        covariance = np.zeros((3, 3))  # Tells a stated error of 0 from none.
    if not expected:
        expected = 0.0 if covariance is None else math.sqrt(max(covariance[0, 0] + covariance[1, 1], 0.0))
        number(f"method '{name}': tag '{tag}': expected_error_m", expected, 0.0)
    return place, covariance, float(expected), float(estimate.rms_m)


def _is_covariance(given: np.ndarray) -> bool:
    """Whether the matrix is symmetric and has no negative eigenvalue, but for rounding."""
    rounding = 1e-9 * np.abs(given).max()
    return np.abs(given - given.T).max() <= rounding and np.linalg.eigvalsh(given).min() >= -rounding
