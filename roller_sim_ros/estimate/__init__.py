# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ground estimated back: G and p from vertical drum acceleration and the phase of the eccentric, machine known.

>>> import numpy as np
>>> from roller_sim_ros.estimate import estimate_window
>>> from roller_sim_ros.parameters import Configuration
>>> from roller_sim_ros.session import Session
>>> known = Configuration()
>>> session = Session(known.changed({"soil.shear_modulus_pa": 35e6, "soil.plastic_parameter_m": 0.8e-3}))
>>> settled = [session.advance(128).acceleration_vertical for _ in range(300)][-16:]
>>> found = estimate_window(np.array(settled), known)
>>> print(f"{found.shear_modulus_pa / 1e6:.2f} MPa, {found.plastic_parameter_m * 1e3:.3f} mm")
35.00 MPa, 0.800 mm

`estimate` does so for all samples of a run, window by window, `estimate_trace` for a trace.

Names are imported when they are used, so that the command can show its help without loading the kernels.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from roller_sim_ros.estimate.arrays import estimate
    from roller_sim_ros.estimate.status import EstimateError, Status
    from roller_sim_ros.estimate.trace import TraceOptions, WindowOfTrace, estimate_trace
    from roller_sim_ros.estimate.window import WindowEstimate, estimate_window

_PLACES = {
    "EstimateError": "status",
    "Status": "status",
    "TraceOptions": "trace",
    "WindowEstimate": "window",
    "WindowOfTrace": "trace",
    "estimate": "arrays",
    "estimate_trace": "trace",
    "estimate_window": "window",
}

__all__ = [
    "estimate",
    "estimate_window",
    "estimate_trace",
    "WindowEstimate",
    "WindowOfTrace",
    "TraceOptions",
    "Status",
    "EstimateError",
]


def __getattr__(name: str) -> Any:
    """Import a public name from its module."""
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
