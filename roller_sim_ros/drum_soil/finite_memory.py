# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A half space of finite memory inside one step: how its surface goes on, and how it answers.

The free motion within the step is the quintic through its values and rates at this sample and the next two; R is the
cubic through R and s at 0 and h.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil.parts import Pair
from roller_sim_ros.drum_soil.state import MAX_SPLITS
from roller_sim_ros.jit import inlined

Array = NDArray[np.float64]
Free = tuple[float, float, float, float, float, float]

# Columns of the array in which a step leaves where its force bends: time, jump of slope, jump of curvature.
BEND_TIME = 0
BEND_SLOPE = 1
BEND_CURVATURE = 2
BENDS_SHAPE = (MAX_SPLITS + 3, 3)


@inlined
def free_motion(
    h: float, e_0: float, w_0: float, e_1: float, w_1: float, e_2: float, w_2: float
) -> Free:
    """Return the quintic through values and rates of the free motion at 0, h and 2 h.

    As the cubic through those at 0 and h and the two coefficients of u² (1 − u)² (a + b (u − 2)) beside it.
    """
    rise = e_1 - e_0
    a = 0.25 * (e_2 - e_0 + 4.0 * rise - h * (2.0 * w_0 + 4.0 * w_1))
    b = 0.25 * (h * w_2 - (-12.0 * rise + h * (5.0 * w_0 + 8.0 * w_1)) - 12.0 * a)
    return e_0, w_0, e_1, w_1, a, b


@inlined
def answer_within(x: float, h: float, ramp_h: float, step_h: float) -> tuple[float, float, float]:
    """Return P, R and s at 0 ≤ x ≤ h from R and s at h."""
    u = x / h
    ramp_2 = h * u * u * u * ((1.0 - 0.5 * u) * ramp_h + h * step_h * (0.25 * u - 1.0 / 3.0))
    ramp = u * u * ((3.0 - 2.0 * u) * ramp_h + (u - 1.0) * h * step_h)
    step = u * (6.0 * (1.0 - u) * ramp_h / h + (3.0 * u - 2.0) * step_h)
    return ramp_2, ramp, step


@inlined
def known_surface(
    x: float,
    h: float,
    free: Free,
    answer_h: Pair,
    bends: Array,
    count: int,
) -> Pair:
    """Return e and e' at time x of the step if the force went on with its last slope."""
    e_0, w_0, e_1, w_1, a, b = free
    u = x / h
    v = 1.0 - u
    e = (1.0 + 2.0 * u) * v * v * e_0 + u * v * v * h * w_0
    e += u * u * (3.0 - 2.0 * u) * e_1 - u * u * v * h * w_1
    w = 6.0 * u * v * (e_1 - e_0) / h + v * (1.0 - 3.0 * u) * w_0 + u * (3.0 * u - 2.0) * w_1
    more = a + b * (u - 2.0)
    e += u * u * v * v * more
    w += u * v * (2.0 * (1.0 - 2.0 * u) * more + u * v * b) / h
    for j in range(count + 1):
        ramp_2, ramp, step = answer_within(x - bends[j, BEND_TIME], h, answer_h[0], answer_h[1])
        e += bends[j, BEND_SLOPE] * ramp + bends[j, BEND_CURVATURE] * ramp_2
        w += bends[j, BEND_SLOPE] * step + bends[j, BEND_CURVATURE] * ramp
    return e, w
