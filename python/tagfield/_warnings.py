# SPDX-License-Identifier: Apache-2.0
"""Warnings about suspicious but usable input, as Python warnings."""

from __future__ import annotations

import os
import sys
import warnings
from typing import Iterable

from ._checks import spoken

__all__ = ["TagfieldWarning", "tell"]

_HERE = os.path.dirname(os.path.abspath(__file__)) + os.sep


class TagfieldWarning(UserWarning):
    """Warning about suspicious but usable input: a setting without effect, materials guessed from names.

    The same lines are in the attribute ``warnings`` of the scenario or result. Python shows each once per
    line of code; ``warnings.simplefilter("error", tagfield.TagfieldWarning)`` turns them into errors.
    """


def tell(lines: Iterable[str]) -> list[str]:
    """Issues each line as a warning, attributed to the caller's line outside this package; returns them."""
    level, frame = 2, sys._getframe(1)
    while frame is not None and frame.f_code.co_filename.startswith(_HERE):
        frame = frame.f_back
        level += 1
    told = [spoken(line) for line in lines]
    for line in told:
        warnings.warn(line, TagfieldWarning, stacklevel=level)
    return told
