"""Projection of one revolution on the waves of some orders."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.jit import njit

Array = NDArray[np.float64]


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
