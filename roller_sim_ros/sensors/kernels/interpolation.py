# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Values between equidistant samples by a windowed sinc."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.jit import njit

Array = NDArray[np.float64]

HALF_WIDTH = 12
"""Samples on either side that a value is made from."""


@njit
def interpolate(samples: Array, origin: int, places: Array, out: Array) -> None:
    """Interpolate samples at fractional places.

    A sinc under a Blackman window of 2 · 12 samples, its weights made to sum to one, so that a constant stays one.
    Up to 0.75 of the Nyquist frequency gain and images are right within 1e-3.

    Parameters
    ----------
    samples : ndarray, shape (n,)
        Equidistant values.
    origin : int
        Which of them is at the place 0; apart from the places, whose fractions must not depend on it.
    places : ndarray, shape (m,)
        From HALF_WIDTH − 1 − origin to below n − HALF_WIDTH − origin.
    out : ndarray, shape (m,)
        The values there.
    """
    for index in range(places.shape[0]):
        floor = math.floor(places[index])
        part = places[index] - floor
        base = origin + int(floor)
        if part == 0.0:
            out[index] = samples[base]
            continue
        # sin π(part − k) is sin π part with alternating sign.
        sine = math.sin(math.pi * part) / math.pi
        total = 0.0
        weights = 0.0
        for tap in range(1 - HALF_WIDTH, HALF_WIDTH + 1):
            away = part - tap
            turn = math.pi * away / HALF_WIDTH
            window = 0.42 + 0.5 * math.cos(turn) + 0.08 * math.cos(2.0 * turn)
            weight = sine / away * window
            if tap % 2 != 0:
                weight = -weight
            weights += weight
            total += weight * samples[base + tap]
        out[index] = total / weights
