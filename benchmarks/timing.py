# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Two things timed in turn, A B A B, so that both see the same noise; in CPU time, as others use the machine too."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable
from dataclasses import dataclass
from statistics import median


@dataclass(frozen=True)
class Paired:
    """Medians over the rounds, of CPU time.

    Attributes
    ----------
    first_s, second_s : float
        Of each.
    ratio : float
        Median of second over first, round by round.
    """

    first_s: float
    second_s: float
    ratio: float


def paired(
    first: Callable[[], object], second: Callable[[], object], *, rounds: int, repeat_first: int = 1
) -> Paired:
    """Time both in turn.

    Parameters
    ----------
    first, second : callable
        What is timed, once a round.
    rounds : int
        How often.
    repeat_first : int
        Calls of `first` per round, when it is much the shorter; its time is that of one.
    """
    firsts, seconds = [], []
    first()
    second()
    gc_was_on = gc.isenabled()
    gc.disable()
    try:
        for _ in range(rounds):
            start = time.thread_time()
            for _ in range(repeat_first):
                first()
            middle = time.thread_time()
            second()
            end = time.thread_time()
            firsts.append((middle - start) / repeat_first)
            seconds.append(end - middle)
    finally:
        if gc_was_on:
            gc.enable()
    ratios = [after / before for before, after in zip(firsts, seconds, strict=True)]
    return Paired(median(firsts), median(seconds), median(ratios))
