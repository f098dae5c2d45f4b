"""The ground estimated back: G and p from vertical drum acceleration and the phase of the eccentric, machine known.

>>> from roller_sim_ros import estimate
>>> estimate.estimate_window(revolutions, known)          # shape (revolutions, 128), Configuration
WindowEstimate(shear_modulus_pa=…, plastic_parameter_m=…, …)
>>> estimate.estimate(vertical, known)                    # all samples; a list, window by window

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
