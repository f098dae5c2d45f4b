# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Whether a motion has come to repeat to rounding, told from its states at the ends of revolutions.

A run whose state repeats over `REPETITIONS` periods to `TOLERANCE` of its scale has reached its orbit: what follows is
that orbit again, so that its remaining revolutions need not be computed. Changes that shrink from period to period by a
factor μ, the last one being δ, leave δ μ/(1 − μ) of the way; from rest δ is reached only after some 30/(1 − μ) periods,
so that what is left of a run of N revolutions is below δ N/30, far less than the 1e-9 that a sweep promises.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.jit import njit

Array = NDArray[np.float64]

TOLERANCE = 1e-13
"""Change of a state from period to period, as a share of its scale, that is rounding."""

REPETITIONS = 8
"""Periods in a row over which the state has to repeat."""

LONGEST_PERIOD = 8
"""Revolutions."""

_PERIODS = 4
"""How many periods are looked for: 1, 2, 4, 8."""

# Rows of the array that watches a trajectory: its last states in a ring, the tolerances of the state's values, and
# counts: revolutions seen, then for each period the ends of revolutions in a row at which the state repeated.
_TOLERANCES = LONGEST_PERIOD
_COUNTS = LONGEST_PERIOD + 1
WATCH_ROWS = LONGEST_PERIOD + 2


@njit
def begin_watch(scales: Array, watch: Array) -> None:
    """Make ready to watch a trajectory.

    Parameters
    ----------
    scales : ndarray, shape (STATE_SIZE,)
        Size of each value of the state.
    watch : ndarray, shape (WATCH_ROWS, STATE_SIZE)
        Made ready.
    """
    watch[:] = 0.0
    for i in range(at.STATE_SIZE):
        watch[_TOLERANCES, i] = TOLERANCE * scales[i]


@njit
def repeats(state: Array, watch: Array) -> int:
    """Note the state at the end of a revolution; return the period if it has repeated for long enough, else 0.

    Parameters
    ----------
    state : ndarray, shape (STATE_SIZE,)
        As the kernels have it. The depth counts from the datum: a drum that sinks evenly repeats.
    watch : ndarray, shape (WATCH_ROWS, STATE_SIZE)
        From `begin_watch`.
    """
    seen = int(watch[_COUNTS, 0])
    found = 0
    period = 1
    for k in range(_PERIODS):
        same = seen >= period
        if same:
            before = (seen - period) % LONGEST_PERIOD
            for i in range(at.DATUM):
                change = state[i] - watch[before, i]
                if i == at.DEPTH:
                    change -= state[at.DATUM] - watch[before, at.DATUM]
                if not abs(change) <= watch[_TOLERANCES, i]:
                    same = False
                    break
        if same and state[at.PHASE] == watch[before, at.PHASE]:
            watch[_COUNTS, k + 1] += 1.0
        else:
            watch[_COUNTS, k + 1] = 0.0
        if found == 0 and watch[_COUNTS, k + 1] >= REPETITIONS * period:
            found = period
        period *= 2
    slot = seen % LONGEST_PERIOD
    for i in range(at.STATE_SIZE):
        watch[slot, i] = state[i]
    watch[_COUNTS, 0] = seen + 1.0
    return found
