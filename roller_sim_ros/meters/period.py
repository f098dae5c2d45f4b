# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""After how many revolutions the motion repeats: 1, 2, 4, 8, or not at all.

P revolutions are a period when the vertical acceleration repeats within 1 % of its peak:
``max |a(t + P) − a(t)| ≤ 0.01 max |a|`` over the window. A claim of P needs a window of at least 2
P revolutions. So a window of fewer than 16 revolutions cannot tell 8 from none: where it finds no
shorter period its answer is unknown, never none. A transient does not repeat either: none is chaos
only in a motion that has settled.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters import kernels
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

CANDIDATES = (1, 2, 4, 8)
"""Periods that are looked for, in revolutions."""

TOLERANCE = 0.01
"""Share of the peak within which the motion has to repeat."""

NO_PERIOD = 0
"""The motion does not repeat within 8 revolutions."""


def period(
    vertical: NDArray[np.floating], samples_per_revolution: int = SAMPLES_PER_REVOLUTION
) -> int | None:
    """Return the period of a whole array.

    Parameters
    ----------
    vertical : ndarray, shape (revolutions × samples_per_revolution,)
        Vertical coordinate acceleration, m/s².
    samples_per_revolution : int
        Samples in one revolution.

    Returns
    -------
    int or None
        1, 2, 4, 8, `NO_PERIOD` = 0, or None when the array is too short to tell.
    """
    samples = np.asarray(vertical, dtype=np.float64)
    revolutions = len(samples) // samples_per_revolution
    bound = TOLERANCE * np.max(np.abs(samples), initial=0.0)
    for candidate in CANDIDATES:
        if 2 * candidate > revolutions:
            return None
        shift = candidate * samples_per_revolution
        if np.max(np.abs(samples[shift:] - samples[:-shift])) <= bound:
            return candidate
    return NO_PERIOD


class PeriodWindow:
    """Sliding window of whole revolutions; `push` one revolution, read `period`.

    The peak is taken about the window's mean, so that an accelerometer that reads specific force
    (gravity added) or has a bias gives the same period.

    Parameters
    ----------
    window_revolutions : int
        Revolutions in the window.
    samples_per_revolution : int
        Samples in one revolution.
    tolerance : float
        Share of the peak within which the motion has to repeat.
    """

    def __init__(
        self,
        window_revolutions: int,
        samples_per_revolution: int = SAMPLES_PER_REVOLUTION,
        tolerance: float = TOLERANCE,
    ) -> None:
        self.window_revolutions = window_revolutions
        self.tolerance = tolerance
        self._back = np.array([p for p in CANDIDATES if 2 * p <= window_revolutions], np.int64)
        self._revolutions = np.zeros((window_revolutions, samples_per_revolution))
        self._changes = np.zeros((len(self._back), window_revolutions))
        self._extremes = np.zeros((3, window_revolutions))
        self._pushed = 0

    def clear(self) -> None:
        """Forget all revolutions."""
        self._pushed = 0

    @property
    def full(self) -> bool:
        """Whether the window holds all its revolutions."""
        return self._pushed >= self.window_revolutions

    def push(self, revolution: NDArray[np.float64]) -> None:
        """Add the newest revolution, shape (samples_per_revolution,), m/s²; drop the oldest."""
        slot = self._pushed % self.window_revolutions
        kernels.note_changes(
            self._revolutions,
            self._changes,
            self._extremes,
            slot,
            self._back,
            np.ascontiguousarray(revolution),
        )
        self._pushed += 1

    def repetitions(self, period: int) -> NDArray[np.float64]:
        """Return the window's samples in rows of a period each, oldest first; at least two rows.

        Parameters
        ----------
        period : int
            Revolutions in a row; `NO_PERIOD` for half the window.
        """
        length = period or self.window_revolutions // 2
        rows = self.window_revolutions // length
        newest = self._pushed - np.arange(rows * length, 0, -1)
        revolutions = self._revolutions[newest % self.window_revolutions]
        return revolutions.reshape(rows, -1)

    def period(self) -> int | None:
        """Return 1, 2, 4, 8, `NO_PERIOD`, or None when the window is not full or too short."""
        if not self.full:
            return None
        newest = (self._pushed - 1) % self.window_revolutions
        found = kernels.first_period(
            self._changes,
            self._extremes,
            newest,
            self._back,
            self._revolutions.shape[1],
            self.tolerance,
        )
        if found:
            return int(found)
        return NO_PERIOD if len(self._back) == len(CANDIDATES) else None
