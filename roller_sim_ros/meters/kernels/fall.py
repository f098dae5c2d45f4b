# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The test for flights of `roller_sim_ros.meters.flight`, on one motion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.jit import njit

Array = NDArray[np.float64]
Test = tuple[int, float, int, float]
"""h in samples and the cosine of its angle, length in samples and tolerance."""

CANNOT_TELL, NEVER_LIFTS, LIFTS = -1, 0, 1


@njit
def _combine(motion: Array, step: int, cosine: float, fall: Array) -> None:
    """Fill in c_n of a motion taken as periodic, m/s²."""
    samples = motion.shape[0]
    share = 1.0 / (2.0 * (1.0 - cosine))
    for i in range(samples):
        after = i + step if i + step < samples else i + step - samples
        around = motion[after] + motion[i - step]
        fall[i] = (around - 2.0 * cosine * motion[i]) * share


@njit
def _has_level(fall: Array, length: int, tolerance: float, ceiling: float) -> bool:
    """Whether `length` values in a row, the ends joined, are level and none is above the ceiling."""
    samples = fall.shape[0]
    for start in range(samples):
        highest, lowest = fall[start], fall[start]
        n = 1
        while n < length and highest <= ceiling:
            value = fall[start + n - samples]
            highest = max(highest, value)
            lowest = min(lowest, value)
            n += 1
        if highest <= ceiling and highest - lowest <= -tolerance * highest:
            return True
    return False


@njit
def lifting(
    repetitions: Array, coarse: Test, fine: Test, ceiling: float, noise: float, scratch: Array
) -> int:
    """Return whether a motion has a flight: LIFTS, NEVER_LIFTS or CANNOT_TELL.

    Parameters
    ----------
    repetitions : ndarray, shape (repetitions, samples)
        Vertical acceleration, m/s², oldest first; at least two.
    coarse, fine : tuple
        The two tests.
    ceiling : float
        In a flight c_n is not above this, m/s².
    noise : float
        Below which c_n of the difference between repetitions lets a flight be seen, m/s².
    scratch : ndarray, shape (2, samples)
        Overwritten.
    """
    times, samples = repetitions.shape
    motion, fall = scratch[0], scratch[1]
    motion[:] = 0.0
    for n in range(times):
        for i in range(samples):
            motion[i] += repetitions[n, i]
    mean = 0.0
    for i in range(samples):
        motion[i] /= times
        mean += motion[i]
    mean /= samples
    for i in range(samples):
        motion[i] -= mean
    _combine(motion, coarse[0], coarse[1], fall)
    if fall.min() > ceiling:
        return NEVER_LIFTS
    if _has_level(fall, coarse[2], coarse[3], ceiling):
        return LIFTS
    _combine(motion, fine[0], fine[1], fall)
    if _has_level(fall, fine[2], fine[3], ceiling):
        return LIFTS
    for i in range(samples):
        motion[i] = repetitions[times - 1, i] - repetitions[times - 2, i]
    _combine(motion, fine[0], fine[1], fall)
    for i in range(samples):
        if not abs(fall[i]) < noise:
            return CANNOT_TELL
    return NEVER_LIFTS
