"""Revolution after revolution of one plan inside compiled code, until the motion repeats to rounding.

A run whose state at the ends of revolutions repeats over `REPETITIONS` periods to `TOLERANCE` of its scale has reached
its orbit: what follows is that orbit again. So its remaining revolutions need not be computed. Reached from rest, with
changes that shrink from period to period by a factor μ, the rest of the way is δ μ/(1 − μ), δ the last change; a factor
near 1 would not have come down to δ so soon, so that the rest is some δ, far below the 1e-9 that a sweep promises.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import exact_kernel, rational_kernel, two_pole_kernel
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.jit import njit

Array = NDArray[np.float64]
Arguments = tuple[Any, ...]

TOLERANCE = 1e-13
"""Largest change of a state from period to period, as a share of its scale, that is rounding."""

REPETITIONS = 8
"""Periods in a row over which the state has to repeat."""

LONGEST_PERIOD = 8
"""Revolutions."""

_PERIODS = 4
"""How many periods are looked for: 1, 2, 4, 8."""

# Rows of the array that watches a trajectory: its last states in a ring, the scales of the state's values, and
# counts: revolutions seen, then for each period the ends of revolutions in a row at which the state repeated.
_SCALES = LONGEST_PERIOD
_COUNTS = LONGEST_PERIOD + 1
WATCH_ROWS = LONGEST_PERIOD + 2


def watch(scales: Array) -> Array:
    """Return what `repeats` needs to watch a trajectory.

    Parameters
    ----------
    scales : ndarray, shape (STATE_SIZE,)
        Size of each value of the state; of no value 0.
    """
    rows = np.zeros((WATCH_ROWS, at.STATE_SIZE))
    rows[_SCALES] = scales
    return rows


@njit
def repeats(state: Array, watched: Array) -> int:
    """Note the state at the end of a revolution; return the period if it has repeated for long enough, else 0."""
    seen = int(watched[_COUNTS, 0])
    period = 1
    found = 0
    for k in range(_PERIODS):
        same = seen >= period
        if same:
            before = watched[(seen - period) % LONGEST_PERIOD]
            datum = state[at.DATUM] - before[at.DATUM]
            for i in range(at.DATUM):
                change = state[i] - before[i]
                if i == at.DEPTH:
                    change -= datum
                same = same and abs(change) <= TOLERANCE * watched[_SCALES, i]
            same = same and state[at.PHASE] == before[at.PHASE]
        watched[_COUNTS, k + 1] = watched[_COUNTS, k + 1] + 1.0 if same else 0.0
        if found == 0 and watched[_COUNTS, k + 1] >= REPETITIONS * period:
            found = period
        period *= 2
    slot = seen % LONGEST_PERIOD
    for i in range(at.STATE_SIZE):
        watched[slot, i] = state[i]
    watched[_COUNTS, 0] = seen + 1
    return found


@njit
def _exact(
    revolutions: int, watching: bool, watched: Array, arguments: Arguments, out: Array
) -> tuple[int, int]:
    for done in range(revolutions):
        every: Arguments = (out.shape[2], 0) + arguments + (out[done % out.shape[0]],)  # noqa: RUF005
        exact_kernel.advance(*every)
        if watching:
            period = repeats(arguments[0], watched)
            if period > 0 and (revolutions - done - 1) % period == 0:
                return done + 1, period
    return revolutions, 0


@njit
def _rational(
    revolutions: int, watching: bool, watched: Array, arguments: Arguments, out: Array
) -> tuple[int, int]:
    for done in range(revolutions):
        every: Arguments = (out.shape[2], 0) + arguments + (out[done % out.shape[0]],)  # noqa: RUF005
        rational_kernel.advance(*every)
        if watching:
            period = repeats(arguments[0], watched)
            if period > 0 and (revolutions - done - 1) % period == 0:
                return done + 1, period
    return revolutions, 0


@njit
def _two_pole(
    revolutions: int, watching: bool, watched: Array, arguments: Arguments, out: Array
) -> tuple[int, int]:
    for done in range(revolutions):
        every: Arguments = (out.shape[2], 0) + arguments + (out[done % out.shape[0]],)  # noqa: RUF005
        two_pole_kernel.advance(*every)
        if watching:
            period = repeats(arguments[0], watched)
            if period > 0 and (revolutions - done - 1) % period == 0:
                return done + 1, period
    return revolutions, 0


LOOPS: dict[str, Callable[[int, bool, Array, Arguments, Array], tuple[int, int]]] = {
    "exact": _exact,
    "rational": _rational,
    "two-pole": _two_pole,
}
"""For each half space: step over some revolutions of one plan.

Parameters
----------
revolutions : int
    At most so many.
watching : bool
    Stop where the motion repeats to rounding and the rest is a whole number of its periods.
watched : ndarray
    From `watch`.
arguments : tuple of ndarray
    Of the kernel, between the samples and the output.
out : ndarray, shape (n, OUT_ROWS, samples)
    Receives the last n revolutions, in the place of their number modulo n.

Returns
-------
done, period : int
    Revolutions stepped over; revolutions after which the motion repeats, 0 where that was not asked or found.
"""
