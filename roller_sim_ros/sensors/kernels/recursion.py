# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Linear recursions of one and of two states."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.jit import njit

Array = NDArray[np.float64]


@njit
def recurse_one(factor: float, inputs: Array, state: Array, out: Array) -> None:
    """Step x ← factor · x + input over all inputs, keep each x.

    Parameters
    ----------
    factor : float
        Of the state.
    inputs, out : ndarray, shape (n,)
        What is added in each step, and x after it.
    state : ndarray, shape (1,)
        x, changed in place.
    """
    x = state[0]
    for index in range(inputs.shape[0]):
        x = factor * x + inputs[index]
        out[index] = x
    state[0] = x


@njit
def recurse_two(matrix: Array, inputs: Array, state: Array, out: Array) -> None:
    """Step x ← matrix · x + input over all inputs, keep the first component of each x.

    Parameters
    ----------
    matrix : ndarray, shape (2, 2)
        Of the state.
    inputs : ndarray, shape (2, n)
        What is added in each step.
    state : ndarray, shape (2,)
        x, changed in place.
    out : ndarray, shape (n,)
        x_0 after each step.
    """
    x, y = state[0], state[1]
    for index in range(inputs.shape[1]):
        next_x = matrix[0, 0] * x + matrix[0, 1] * y + inputs[0, index]
        y = matrix[1, 0] * x + matrix[1, 1] * y + inputs[1, index]
        x = next_x
        out[index] = x
    state[0] = x
    state[1] = y
