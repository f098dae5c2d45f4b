# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Blocks of a motion that is given, not simulated."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.session.block import Block

Array = NDArray[np.float64]
Motion = Callable[[Array], Array]
SAMPLES = 128


def still(time_s: Array) -> Array:
    return np.zeros_like(time_s)


def blocks(
    revolutions: int,
    vertical: Motion = still,
    horizontal: Motion = still,
    *,
    hz: float | list[float] = 28.0,
    size: int = SAMPLES,
) -> Iterator[Block]:
    """Yield the blocks of a motion over time, each revolution at its frequency."""
    start_s = 0.0
    for revolution in range(revolutions):
        frequency = hz[revolution] if isinstance(hz, list) else hz
        period_s = 1.0 / (frequency * SAMPLES)
        for first in range(0, SAMPLES, size):
            time_s = start_s + period_s * np.arange(first, first + size)
            zero = np.zeros(size)
            yield Block(
                first_sample=revolution * SAMPLES + first,
                time_s=start_s + first * period_s,
                sample_period_s=period_s,
                excitation_hz=frequency,
                eccentric_phase_rad=2.0 * np.pi * first / SAMPLES,
                phase_increment_rad=2.0 * np.pi / SAMPLES,
                acceleration_vertical=vertical(time_s),
                acceleration_horizontal=horizontal(time_s),
                soil_force=zero,
                drum_height=zero,
                soil_displacement=zero,
                plastic_depth=zero,
                height_datum=zero,
                contact_state=zero.astype(np.uint8),
                shear_modulus_pa=50e6,
                plastic_parameter_m=0.65e-3,
            )
        start_s += SAMPLES * period_s
