# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Sweeps: what the roller settles on over a whole grid of parameters.

>>> from roller_sim_ros import sweep
>>> grid = sweep.Grid((sweep.Axis("exciter.frequency_hz", (26.0, 28.0)),))
>>> sweep.run(grid).period.values
array([2., 2.], dtype=float32)

Names are imported when they are used, so that axes can be spoken of without loading the kernels.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from roller_sim_ros.sweep.axis import Axis
    from roller_sim_ros.sweep.errors import AxisError, SweepFileError, SweepStopped
    from roller_sim_ros.sweep.file import read, write
    from roller_sim_ros.sweep.filling import fill, run
    from roller_sim_ros.sweep.grid import Grid
    from roller_sim_ros.sweep.plan import Continuation, Plan
    from roller_sim_ros.sweep.results import Results
    from roller_sim_ros.sweep.task import values_at
    from roller_sim_ros.sweep.values import VALUES, Value

_PLACES = {
    "Axis": "axis",
    "AxisError": "errors",
    "Continuation": "plan",
    "Grid": "grid",
    "Plan": "plan",
    "Results": "results",
    "SweepFileError": "errors",
    "SweepStopped": "errors",
    "VALUES": "values",
    "Value": "values",
    "fill": "filling",
    "read": "file",
    "run": "filling",
    "values_at": "task",
    "write": "file",
}

__all__ = [
    "Axis",
    "Grid",
    "Plan",
    "Continuation",
    "run",
    "fill",
    "values_at",
    "Results",
    "read",
    "write",
    "VALUES",
    "Value",
    "AxisError",
    "SweepFileError",
    "SweepStopped",
]


def __getattr__(name: str) -> Any:
    """Import a public name from its module."""
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
