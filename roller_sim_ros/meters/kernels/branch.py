# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The modulus of `roller_sim_ros.meters.e_vib` from force and travel."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.jit import njit
from roller_sim_ros.meters.kernels.line_contact import modulus

Array = NDArray[np.float64]

_FEWEST_POINTS = 2


@njit
def _peak(force: Array, start: int, span: int) -> int:
    """Return where some samples have their greatest force.

    Only summits count: at the end of a span the force of the next one's blow may already be rising.
    """
    samples = force.shape[0]
    found, greatest = start, -math.inf
    for i in range(start, start + span):
        value = force[i]
        after = force[i + 1] if i + 1 < samples else force[0]
        if value > greatest and value >= force[i - 1] and value >= after:
            found, greatest = i, value
    return found


@njit
def _slope(
    force: Array, height: Array, first: int, count: int, radius: float, width: float, nu: float
) -> float:
    """Return the modulus that makes a line contact as steep as the regression of some samples, NaN for too few."""
    samples = force.shape[0]
    if count < _FEWEST_POINTS:
        return math.nan
    mean = 0.0
    for n in range(count):
        mean += force[(first + n) % samples]
    mean /= count
    squares, travel, logarithm = 0.0, 0.0, 0.0
    for n in range(count):
        i = (first + n) % samples
        value = force[i]
        apart = value - mean
        squares += apart * apart
        travel -= apart * height[i]
        if value > 0.0:
            logarithm += apart * (value * math.log(value))
    if not squares > 0.0:
        return math.nan
    return modulus(travel / squares, logarithm / squares, radius, width, nu)


@njit
def mean_modulus(
    forces: Array,
    heights: Array,
    static_load: Array,
    radius: Array,
    width: Array,
    poisson_ratio: float,
    samples_per_revolution: int,
    low: float,
    high: float,
    out: Array,
) -> None:
    """Fill in E_vib of some motions, Pa: the mean over every two revolutions, NaN where none has a value.

    Parameters
    ----------
    forces, heights : ndarray, shape (motions, samples)
        F_s, N, and height, m, up positive; each window is taken to repeat.
    static_load, radius, width : ndarray, shape (motions,)
        F_stat, r and W.
    poisson_ratio : float
        ν of the ground.
    samples_per_revolution : int
        Samples in one revolution.
    low, high : float
        Part of the branch that is taken.
    out : ndarray, shape (motions,)
        Receives E_vib.
    """
    motions, samples = forces.shape
    span = 2 * samples_per_revolution
    for m in range(motions):
        force = forces[m]
        total, known = 0.0, 0
        for start in range(0, samples, span):
            peak = _peak(force, start, span)
            top = force[peak]
            if not top > static_load[m]:
                continue
            # The branch begins after the last sample below it, and ends before the first one above.
            lowest = top
            for n in range(samples_per_revolution):
                lowest = min(lowest, force[peak - 1 - n])
            floor, ceiling = lowest + low * (top - lowest), lowest + high * (top - lowest)
            back = 0
            while back < samples_per_revolution and not force[peak - back] < floor:
                back += 1
            if not force[peak - back] < floor:
                back += 1
            count = 0
            while count < back and not force[peak - back + 1 + count] > ceiling:
                count += 1
            found = _slope(
                force, heights[m], peak - back + 1, count, radius[m], width[m], poisson_ratio
            )
            if math.isfinite(found):
                total += found
                known += 1
        out[m] = total / known if known > 0 else math.nan
