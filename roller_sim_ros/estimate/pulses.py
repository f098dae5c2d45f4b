# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The phase of the eccentric at any time, from the pulses of its tacho alone."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LONGEST_S = 0.5
"""Between two pulses, beyond which nothing is known of what is between."""


class PulsePhase:
    """Straight lines between pulses; a pulse that is missing leaves twice the time to the next, and is counted.

    Parameters
    ----------
    times_s : sequence of float
        When the pulses came, rising.
    phases_rad : sequence of float
        Phase of the eccentric that each marks, rad.
    """

    def __init__(self, times_s: Sequence[float], phases_rad: Sequence[float]) -> None:
        self._times = np.asarray(times_s, dtype=np.float64)
        intervals = np.diff(self._times)
        counts = np.ones(len(intervals))
        usual = math.nan
        for i, interval in enumerate(intervals):
            if interval > LONGEST_S:
                usual = math.nan
                continue
            if not math.isnan(usual):
                counts[i] = max(1, round(interval / usual))
            usual = interval / counts[i]
        phases = np.asarray(phases_rad, dtype=np.float64) / (2.0 * math.pi)
        self._turns = np.concatenate([[0.0], np.cumsum(counts)])[: len(phases)] + phases
        # Stretches between pulses that say nothing.
        self._unknown = np.concatenate([[True], intervals > LONGEST_S, [True]])

    def turns(self, times_s: Array) -> Array:
        """Return phases in revolutions at some times, NaN where no pulses are near."""
        if not len(self._times):
            return np.full(times_s.shape, np.nan)
        found = np.interp(times_s, self._times, self._turns)
        after = np.searchsorted(self._times, times_s, side="right")
        return np.where(self._unknown[after], np.nan, found)
