# SPDX-License-Identifier: Apache-2.0
"""What is odd, but usable, as Python's warnings."""

from __future__ import annotations

import os
import sys
import warnings
from typing import Iterable

__all__ = ["TagfieldWarning", "tell"]

_HERE = os.path.dirname(os.path.abspath(__file__)) + os.sep


class TagfieldWarning(UserWarning):
    """Something odd, but usable: a setting without effect, materials guessed from names.

    The same lines are in the ``warnings`` of what they are about. Python shows each once for a line of code;
    ``warnings.simplefilter("error", tagfield.TagfieldWarning)`` makes them errors.
    """


def tell(lines: Iterable[str]) -> None:
    """Warns of each line, at the caller's line outside of this package."""
    level, frame = 2, sys._getframe(1)
    while frame is not None and frame.f_code.co_filename.startswith(_HERE):
        frame = frame.f_back
        level += 1
    for line in lines:
        warnings.warn(line, TagfieldWarning, stacklevel=level)
