# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The last revolutions of several runs, in memory that is used again and again."""

from __future__ import annotations

import threading

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import state as at

Array = NDArray[np.float64]

ROWS = (at.OUT_VERTICAL, at.OUT_FORCE, at.OUT_DEPTH, at.OUT_PHASE)
"""What of a kernel's output is kept, in the order of the records' rows."""

VERTICAL, FORCE, DEPTH, PHASE = range(len(ROWS))

_MOST_BYTES = 48 << 20
"""Of the records of one task."""

_own = threading.local()


class Records:
    """Samples of the last revolutions of some points.

    Attributes
    ----------
    samples : ndarray, shape (points, revolutions, len(ROWS), samples)
        The revolutions that were recorded, from the first place on.
    recorded : ndarray of int, shape (points,)
        How many: those that were asked for, or one period of a motion that repeats to rounding.
    computed : ndarray of int, shape (points,)
        Revolutions that were stepped over.
    synchronous : ndarray of bool, shape (points,)
        Whether every revolution of samples is one of the eccentric, all at one frequency.
    """

    def __init__(self, points: int, revolutions: int, samples: int) -> None:
        size = points * revolutions * len(ROWS) * samples
        memory: Array | None = getattr(_own, "memory", None)
        if memory is None or len(memory) < size:
            # Fresh memory costs as much as computing what goes into it.
            memory = _own.memory = np.empty(size)
        self.samples = memory[:size].reshape(points, revolutions, len(ROWS), samples)
        self.recorded = np.zeros(points, dtype=np.int64)
        self.computed = np.zeros(points, dtype=np.int64)
        self.synchronous = np.ones(points, dtype=np.bool_)

    def keep(self, point: int, revolution: int, out: Array) -> None:
        """Record one revolution of a kernel's output, shape (OUT_ROWS, samples)."""
        for row, source in enumerate(ROWS):
            self.samples[point, revolution, row] = out[source]


def most_points(revolutions: int, samples: int) -> int:
    """Return of how many points the records are not too large."""
    return max(1, _MOST_BYTES // (8 * revolutions * len(ROWS) * samples))
