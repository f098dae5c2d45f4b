# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a trace says of the ground: a list of JSON objects and a table."""

from __future__ import annotations

import math
from typing import Any

from roller_sim_ros.estimate.status import Status
from roller_sim_ros.estimate.trace import TraceEstimate, WindowOfTrace


def as_list(estimate: TraceEstimate) -> list[dict[str, Any]]:
    """Return one object of JSON values for each window; what is unknown is None."""
    return [_object(window) for window in estimate.windows]


def _object(window: WindowOfTrace) -> dict[str, Any]:
    found = window.estimate
    return {
        "start": window.start_s,
        "end": window.end_s,
        "start_time_ns": window.start_ns,
        "revolutions": window.revolutions,
        "excitation_hz": _finite(window.excitation_hz),
        "amplitude_mm": _finite(window.amplitude_m * 1e3),
        "shear_modulus_mpa": _finite(found.shear_modulus_pa / 1e6),
        "shear_modulus_spread_mpa": _finite(found.shear_modulus_spread_pa / 1e6),
        "plastic_mm": _finite(found.plastic_parameter_m * 1e3),
        "plastic_spread_mm": _finite(found.plastic_spread_m * 1e3),
        "correlation": _finite(found.correlation),
        "status": found.status.label,
        "meaning": found.status.meaning,
        "period": found.period or None,
        "misfit_m_s2": _finite(found.misfit_m_s2),
        "misfit_share": _finite(found.misfit_share),
        "noise_m_s2": _finite(found.noise_m_s2),
    }


COLUMNS = "   start s       Hz      mm     G MPa       ±      p mm       ±  misfit  status"


def as_table(estimate: TraceEstimate) -> str:
    """Return a table with a line for each window, and what its statuses mean."""
    half_space = estimate.known.half_space
    machine = estimate.known.machine
    lines = [
        (
            f"{estimate.topic}: drum {machine.drum_mass_kg:g} kg, frame {machine.frame_mass_kg:g} kg, half space "
            f"{half_space.model}, k {half_space.area_factor:g}"
        ),
        COLUMNS,
        *(_line(window) for window in estimate.windows),
    ]
    for status in Status:
        count = sum(window.estimate.status is status for window in estimate.windows)
        if count and status is not Status.OK:
            lines.append(f"{status.label}, {count} of {len(estimate.windows)}: {status.meaning}")
    return "\n".join(lines)


def _line(window: WindowOfTrace) -> str:
    found = window.estimate
    return (
        f"{window.start_s:10.3f} {_cell(window.excitation_hz, 8, 2)} {_cell(window.amplitude_m * 1e3, 7, 3)} "
        f"{_cell(found.shear_modulus_pa / 1e6, 9, 3)} {_cell(found.shear_modulus_spread_pa / 1e6, 7, 3)} "
        f"{_cell(found.plastic_parameter_m * 1e3, 9, 4)} {_cell(found.plastic_spread_m * 1e3, 7, 4)} "
        f"{_cell(found.misfit_share * 100.0, 5, 1)} %  {found.status.label}"
    )


def _cell(value: float, width: int, digits: int) -> str:
    number = _finite(value)
    return f"{'–':>{width}}" if number is None else f"{number:{width}.{digits}f}"


def _finite(value: float) -> float | None:
    """Return a number, None for NaN and infinities: for JSON."""
    return value if math.isfinite(value) else None
