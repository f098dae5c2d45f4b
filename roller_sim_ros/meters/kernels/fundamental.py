# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Fundamental of motions and the soil's force in them, with the eccentric's sine and cosine."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.jit import njit

Array = NDArray[np.float64]


@njit
def fundamentals(vertical: Array, sine: Array, cosine: Array, out: NDArray[np.complex128]) -> None:
    """Fill in C_1 = 2/M Σ a exp(−iφ), m/s².

    Parameters
    ----------
    vertical : ndarray, shape (motions, revolutions × samples)
        Acceleration, m/s².
    sine, cosine : ndarray, shape (samples,)
        Of the eccentric in a revolution.
    out : ndarray of complex, shape (motions,)
        Receives C_1.
    """
    motions, length = vertical.shape
    samples = sine.shape[0]
    for n in range(motions):
        real, imaginary = 0.0, 0.0
        for first in range(0, length, samples):
            part, turned = 0.0, 0.0
            for i in range(samples):
                part += vertical[n, first + i] * cosine[i]
                turned += vertical[n, first + i] * sine[i]
            real += part
            imaginary -= turned
        out[n] = complex(2.0 * real / length, 2.0 * imaginary / length)


@njit
def soil_forces(
    vertical: Array, mass: Array, static_load: Array, amplitude: Array, sine: Array, out: Array
) -> None:
    """Fill in F_s = m_d (z'' − mean) − F sin φ + F_stat, N.

    Parameters
    ----------
    vertical : ndarray, shape (motions, revolutions × samples)
        Acceleration, m/s².
    mass, static_load, amplitude : ndarray, shape (motions,)
        m_d, F_stat and F of each motion.
    sine : ndarray, shape (samples,)
        Of the eccentric in a revolution.
    out : ndarray, shape (motions, revolutions × samples)
        Receives F_s.
    """
    motions, length = vertical.shape
    samples = sine.shape[0]
    for n in range(motions):
        mean = 0.0
        for first in range(0, length, samples):
            part = 0.0
            for i in range(samples):
                part += vertical[n, first + i]
            mean += part
        mean /= length
        for first in range(0, length, samples):
            for i in range(samples):
                rest = static_load[n] - amplitude[n] * sine[i]
                out[n, first + i] = mass[n] * (vertical[n, first + i] - mean) + rest
