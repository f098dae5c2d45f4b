# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A second-order low-pass at a changing sample period: exact for a straight line from sample to sample, and for noise.

y'' = ω² (u − y) − √2 ω y' (Butterworth), states y and y'/ω. The step over a sample period is the matrix exponential
of the states with the input's line among them.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

Array = NDArray[np.float64]
DAMPING = math.sqrt(0.5)


class Step(NamedTuple):
    """x ← matrix · x + hold · u_before + slope · (u − u_before).

    Attributes
    ----------
    matrix : ndarray, shape (2, 2)
    hold, slope : ndarray, shape (2,)
    """

    matrix: Array
    hold: Array
    slope: Array


def _system(bandwidth_hz: float) -> tuple[Array, Array]:
    omega = 2.0 * math.pi * bandwidth_hz
    return (
        np.array([[0.0, omega], [-omega, -2.0 * DAMPING * omega]]),
        np.array([0.0, omega]),
    )


@lru_cache(maxsize=256)
def signal_step(bandwidth_hz: float, period_s: float) -> Step:
    """Return the step of the states over one sample period, the input a straight line."""
    dynamics, entry = _system(bandwidth_hz)
    block = np.zeros((4, 4))
    block[:2, :2] = dynamics * period_s
    block[:2, 2] = entry * period_s
    block[2, 3] = 1.0
    power = expm(block)
    return Step(power[:2, :2].copy(), power[:2, 2].copy(), power[:2, 3].copy())


@lru_cache(maxsize=256)
def noise_step(bandwidth_hz: float, period_s: float) -> tuple[Array, Array]:
    """Return (matrix, factor): x ← matrix · x + factor · (two standard normal numbers), white noise at the input.

    The noise has the one-sided density 1. Both states then have the stationary variance v of `variance` and no
    covariance, so what a step adds has the covariance v (1 − matrix · matrixᵀ), whose Cholesky factor this is.
    """
    dynamics, _ = _system(bandwidth_hz)
    matrix = expm(dynamics * period_s)
    added = variance(bandwidth_hz) * (np.eye(2) - matrix @ matrix.T)
    return matrix, np.linalg.cholesky(added)


def variance(bandwidth_hz: float) -> float:
    """Return the variance of y for noise of one-sided density 1: the noise bandwidth, ω/(8 ζ), Hz."""
    return 2.0 * math.pi * bandwidth_hz / (8.0 * DAMPING)
