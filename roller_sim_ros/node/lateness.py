# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How late the blocks were published: noted by the pacing thread, read by another."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

_FIRST_S = 1e-6
_RATIO = 1.05
_BINS = 400  # up to 300 s


@dataclass(frozen=True)
class LatenessSummary:
    """Lateness of a number of blocks; NaN where there was none.

    Attributes
    ----------
    blocks : int
        How many.
    late : int
        How many of them came more than their own duration after their deadline.
    p50_s, p99_s, p999_s, max_s : float
        Percentiles and greatest value, s.
    """

    blocks: int
    late: int
    p50_s: float
    p99_s: float
    p999_s: float
    max_s: float


class Lateness:
    """Lateness of all blocks in bins of 5 %, and of those since the last look exactly."""

    def __init__(self) -> None:
        # A deque's ends are safe between two threads without a lock.
        self._recent: deque[tuple[float, bool]] = deque()
        self._bins = [0] * _BINS
        self._blocks = 0
        self._late = 0
        self._max_s = 0.0

    def note(self, lateness_s: float, duration_s: float) -> None:
        """Note a block's lateness; it counts as late when the next block was due already."""
        late = lateness_s > duration_s
        self._blocks += 1
        self._late += late
        if lateness_s > self._max_s:
            self._max_s = lateness_s
        self._bins[_bin(lateness_s)] += 1
        self._recent.append((lateness_s, late))

    def recent(self) -> LatenessSummary:
        """Return the summary of the blocks since the last call; for one caller only."""
        taken = [self._recent.popleft() for _ in range(len(self._recent))]
        if not taken:
            return LatenessSummary(0, 0, math.nan, math.nan, math.nan, math.nan)
        times = sorted(lateness_s for lateness_s, _ in taken)

        def percentile(share: float) -> float:
            return times[min(len(times) - 1, int(share * len(times)))]

        return LatenessSummary(
            blocks=len(times),
            late=sum(late for _, late in taken),
            p50_s=percentile(0.5),
            p99_s=percentile(0.99),
            p999_s=percentile(0.999),
            max_s=times[-1],
        )

    def total(self) -> LatenessSummary:
        """Return the summary of all blocks; percentiles are the upper ends of their bins."""
        if not self._blocks:
            return LatenessSummary(0, 0, math.nan, math.nan, math.nan, math.nan)

        def percentile(share: float) -> float:
            below = 0
            for index, count in enumerate(self._bins):
                below += count
                if below > share * self._blocks:
                    return min(self._max_s, _FIRST_S * _RATIO**index)
            return self._max_s

        return LatenessSummary(
            blocks=self._blocks,
            late=self._late,
            p50_s=percentile(0.5),
            p99_s=percentile(0.99),
            p999_s=percentile(0.999),
            max_s=self._max_s,
        )


def _bin(lateness_s: float) -> int:
    if lateness_s <= _FIRST_S:
        return 0
    return min(_BINS - 1, math.ceil(math.log(lateness_s / _FIRST_S) / math.log(_RATIO)))
