# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Projection of one revolution on the waves of some orders, and the sums over a window of revolutions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.jit import njit

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_LANES = 8


@njit
def project(waves: Array, revolution: Array, out: Array) -> None:
    """Sum samples times waves.

    Parameters
    ----------
    waves : ndarray, shape (samples, waves)
        The waves, side by side.
    revolution : ndarray, shape (samples,)
        The samples.
    out : ndarray, shape (waves,)
        Receives the sums.
    """
    out[:] = 0.0
    for i in range(waves.shape[0]):
        value = revolution[i]
        for k in range(waves.shape[1]):
            out[k] += waves[i, k] * value


@njit
def keep(
    waves: Array, revolution: Array, products: Array, turns: Array, row: int, sums: Array, slot: int
) -> None:
    """Turn a revolution's sums to where the window counts from, and keep them twice, a window apart.

    Parameters
    ----------
    waves, revolution
        As `project` takes them.
    products : ndarray, shape (2 orders,)
        Receives the sums with the cosines, then with the sines.
    turns : ndarray, shape (2, rows, orders)
        Cosine and sine of the angle, of several revolutions.
    row : int
        Which of them.
    sums : ndarray, shape (2, orders, 2 window)
        The ring: real and imaginary parts.
    slot : int
        Place in it, below the window.
    """
    project(waves, revolution, products)
    orders, window = sums.shape[1], sums.shape[2] // 2
    for k in range(orders):
        real, imaginary = products[k], products[orders + k]
        cosine, sine = turns[0, row, k], turns[1, row, k]
        # (real - i imaginary) times (cosine - i sine)
        turned = real * cosine - imaginary * sine
        sums[0, k, slot] = turned
        sums[0, k, slot + window] = turned
        turned = -(real * sine + imaginary * cosine)
        sums[1, k, slot] = turned
        sums[1, k, slot + window] = turned


@njit
def window_sums(sums: Array, first: int, scale: float, out: Complex) -> None:
    """Sum over the window, in eight lanes as numpy does, and scale.

    Parameters
    ----------
    sums : ndarray, shape (2, orders, 2 window)
        The ring.
    first : int
        Place of the oldest revolution.
    scale : float
        Factor of the sums.
    out : ndarray of complex, shape (orders,)
        Receives them.
    """
    window = sums.shape[2] // 2
    whole = window - window % _LANES
    lanes = np.zeros(_LANES)
    for k in range(sums.shape[1]):
        for part in range(2):
            total = 0.0
            if whole:
                lanes[:] = sums[part, k, first : first + _LANES]
                for n in range(_LANES, whole, _LANES):
                    for lane in range(_LANES):
                        lanes[lane] += sums[part, k, first + n + lane]
                total = ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + (
                    (lanes[4] + lanes[5]) + (lanes[6] + lanes[7])
                )
            for n in range(whole, window):
                total += sums[part, k, first + n]
            if part == 0:
                real = total * scale
            else:
                out[k] = complex(real, total * scale)
