# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""By how much a revolution differs from those before it, and after how many the motion repeats."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.jit import njit

Array = NDArray[np.float64]
Counts = NDArray[np.int64]


@njit
def note_changes(
    revolutions: Array, changes: Array, extremes: Array, slot: int, back: Counts, newest: Array
) -> None:
    """Put the newest revolution into the ring.

    Parameters
    ----------
    revolutions : ndarray, shape (window, samples)
        The ring.
    changes : ndarray, shape (candidates, window)
        Receives the greatest difference from the revolutions some revolutions before, NaN if there is one in it.
    extremes : ndarray, shape (3, window)
        Receives greatest and least value, and the sum.
    slot : int
        Its place in the ring.
    back : ndarray of int, shape (candidates,)
        How many revolutions before.
    newest : ndarray, shape (samples,)
        The samples.
    """
    window, samples = revolutions.shape
    for row in range(back.shape[0]):
        earlier = (slot - back[row]) % window
        worst = 0.0
        for i in range(samples):
            change = abs(newest[i] - revolutions[earlier, i])
            if change > worst or change != change:
                worst = change
        changes[row, slot] = worst
    highest, lowest, total = newest[0], newest[0], 0.0
    for i in range(samples):
        value = newest[i]
        total += value
        highest = max(highest, value)
        lowest = min(lowest, value)
        revolutions[slot, i] = value
    extremes[0, slot] = highest
    extremes[1, slot] = lowest
    extremes[2, slot] = total


@njit
def first_period(
    changes: Array,
    extremes: Array,
    newest: int,
    candidates: Counts,
    samples: int,
    tolerance: float,
) -> int:
    """Return the first candidate after which a full window repeats, 0 for none.

    Parameters
    ----------
    changes, extremes : ndarray
        As `note_changes` fills them.
    newest : int
        Place of the newest revolution in the ring.
    candidates : ndarray of int, shape (candidates,)
        Revolutions.
    samples : int
        Samples in a revolution.
    tolerance : float
        Share of the peak about the mean within which the motion has to repeat.
    """
    window = extremes.shape[1]
    total = 0.0
    highest, lowest = extremes[0, 0], extremes[1, 0]
    for n in range(window):
        total += extremes[2, n]
        highest = max(highest, extremes[0, n])
        lowest = min(lowest, extremes[1, n])
    mean = total / (window * samples)
    bound = tolerance * max(highest - mean, mean - lowest)
    for row in range(candidates.shape[0]):
        repeats = True
        for n in range(window - candidates[row]):
            if not changes[row, (newest - n) % window] <= bound:
                repeats = False
                break
        if repeats:
            return int(candidates[row])
    return 0
