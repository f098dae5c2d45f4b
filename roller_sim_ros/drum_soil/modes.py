# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A rational half space inside a step: a sum of modes, each with its own decay (paper, eq. 9).

e = H0 Re Σ r_j z_j with z_j' = p_j z_j + F. Kept is each mode's distance from rest under the present force,
y_j = z_j + F/p_j, so that y_j' = p_j y_j + F'/p_j: a force that stays lets it decay.
"""

from __future__ import annotations

import cmath

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil.parts import Pair
from roller_sim_ros.jit import inlined, njit

Modes = NDArray[np.complex128]
Triple = tuple[float, float, float]

# Rows of the array of modes, shape (ROWS, number of modes).
POLE = 0
"""p_j, 1/s; one of each conjugate pair."""
WEIGHT = 1
"""H0 r_j, m/(N s); twice the residue where the pole stands for a pair."""
DISTANCE = 2
"""y_j, N s."""
HALF = 3
WHOLE = 4
"""exp(p_j h/2) and exp(p_j h)."""
BY_SLOPE = 5
BY_CURVATURE = 6
"""What F' and F'' at a whole step's start add to y_j by its end."""
ROWS = 7


@njit
def answers_and_motion(
    x: float, force: float, compliance: float, modes: Modes
) -> tuple[Triple, Triple, Pair, Pair]:
    """Return how the surface answers a force, and how it goes on, at the middle and the end of a part.

    Parameters
    ----------
    x
        Length of the part, s.
    force
        F at its start, N.
    compliance
        H0, m/N.
    modes : ndarray, shape (ROWS, m)
        POLE, WEIGHT, DISTANCE at the part's start.

    Returns
    -------
    answer_middle, answer_end
        P, R and s, H0 included.
    known_middle, known_end
        e and e' if the force stayed.
    """
    y = 0.5 * x
    rest = compliance * force
    p_y, r_y, s_y = 0.5 * compliance * y * y, compliance * y, compliance
    p_x, r_x, s_x = 0.5 * compliance * x * x, compliance * x, compliance
    e_y, w_y, e_x, w_x = rest, 0.0, rest, 0.0
    for j in range(modes.shape[1]):
        pole = modes[POLE, j]
        weight = modes[WEIGHT, j]
        half = cmath.exp(pole * y)
        whole = half * half
        share = weight / pole
        s_y += (share * half).real
        s_x += (share * whole).real
        share /= pole
        r_y += (share * (half - 1.0)).real
        r_x += (share * (whole - 1.0)).real
        share /= pole
        p_y += (share * (half - 1.0 - pole * y)).real
        p_x += (share * (whole - 1.0 - pole * x)).real
        part = weight * modes[DISTANCE, j]
        e_y += (part * half).real
        e_x += (part * whole).real
        part *= pole
        w_y += (part * half).real
        w_x += (part * whole).real
    return (p_y, r_y, s_y), (p_x, r_x, s_x), (e_y, w_y), (e_x, w_x)


@inlined
def carry(x: float, slope_start: float, curvature: float, modes: Modes) -> None:
    """Move the distances from rest on by a part of x seconds under a parabolic force.

    Parameters
    ----------
    x
        Length of the part, s.
    slope_start, curvature
        F' at its start, N/s, and F'', N/s².
    modes : ndarray, shape (ROWS, m)
        DISTANCE is changed.
    """
    for j in range(modes.shape[1]):
        pole = modes[POLE, j]
        whole = cmath.exp(pole * x)
        square = pole * pole
        modes[DISTANCE, j] = (
            modes[DISTANCE, j] * whole
            + slope_start * (whole - 1.0) / square
            + curvature * (whole - 1.0 - pole * x) / (square * pole)
        )


@inlined
def step_motion(rest: float, modes: Modes) -> tuple[Pair, Pair]:
    """Return e and e' at the middle and the end of a whole step if the force stayed, from the prepared rows."""
    e_y, w_y, e_x, w_x = rest, 0.0, rest, 0.0
    for j in range(modes.shape[1]):
        part = modes[WEIGHT, j] * modes[DISTANCE, j]
        e_y += (part * modes[HALF, j]).real
        e_x += (part * modes[WHOLE, j]).real
        part *= modes[POLE, j]
        w_y += (part * modes[HALF, j]).real
        w_x += (part * modes[WHOLE, j]).real
    return (e_y, w_y), (e_x, w_x)


@inlined
def carry_step(slope_start: float, curvature: float, modes: Modes) -> None:
    """As `carry`, for a whole step."""
    for j in range(modes.shape[1]):
        modes[DISTANCE, j] = (
            modes[DISTANCE, j] * modes[WHOLE, j]
            + slope_start * modes[BY_SLOPE, j]
            + curvature * modes[BY_CURVATURE, j]
        )


def prepare(h: float, modes: Modes) -> None:
    """Fill the rows of a whole step of h seconds."""
    pole = modes[POLE]
    modes[HALF] = np.exp(0.5 * pole * h)
    modes[WHOLE] = np.exp(pole * h)
    modes[BY_SLOPE] = (modes[WHOLE] - 1.0) / pole**2
    modes[BY_CURVATURE] = (modes[WHOLE] - 1.0 - pole * h) / pole**3
