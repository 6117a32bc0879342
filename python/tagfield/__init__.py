# SPDX-License-Identifier: Apache-2.0
"""Tagfield: UHF RFID simulation, tag localization and evaluation.

    import tagfield

    scenario = tagfield.load(tagfield.share("scenarios/paper_warehouse.yaml"))
    run = scenario.with_({"pose.source": "noisy"}).run(seed=1)
    print(run)
    run.reads.to_pandas()
    tagfield.plot.hall(run)

Lengths are in metres, angles in radians and times in seconds (stamp_ns: nanoseconds), unless a name
states another unit. An invalid input raises tagfield.Error with a one-line message; a suspicious but
usable one issues a tagfield.TagfieldWarning.
See docs/python.md for more.
"""

from . import _core
from ._bench import Bench, bench
from ._core import Error, Link, LinkState, Place, Pose, Read
from ._methods import Estimate, Method, Problem, method
from ._plan import Plan, plan
from ._reads import Calibration, calibrate, localize, methods, poses_table, read, reads_table, track
from ._runs import Coverage, Explanation, Layer, Localization, Run, Scan, Simulation, Tracks, Truth
from ._scenario import Outlet, Scenario, World, load, share
from ._tables import Table, stack
from ._warnings import TagfieldWarning

__version__: str = _core.__version__

Error.__module__ = "tagfield"  # As users know it, and tracebacks print it.

__all__ = [
    "Bench", "Calibration", "Coverage", "Error", "Estimate", "Explanation", "Layer", "Link", "LinkState",
    "Localization", "Method", "Outlet", "Place", "Plan", "Pose", "Problem", "Read", "Run", "Scan", "Scenario",
    "Simulation", "Table", "TagfieldWarning", "Tracks", "Truth", "World", "bench", "calibrate", "load", "localize",
    "method", "methods", "plan", "plot", "poses_table", "read", "reads_table", "share", "stack", "track",
]


def __getattr__(name: str):
    if name == "plot":  # Imported lazily, because it needs matplotlib.
        import importlib

        return importlib.import_module("tagfield.plot")
    raise AttributeError(f"module 'tagfield' has no attribute '{name}'")
