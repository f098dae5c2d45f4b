# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Feeds targets with as many items as are asked for, and tells what came of it."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from hypothesis import HealthCheck, Phase, given, seed, settings

from fuzz.targets import Target

BATCH = 500
"""Sequences for which hypothesis remembers what it drew; without an end it would slow down."""


FIRST_GUESS = 4.0
"""Items in a sequence, before there are any."""


@dataclass
class Result:
    """What came of a target.

    Attributes
    ----------
    items, accepted : int
        Items fed, and how many of them were accepted.
    sequences : int
        In how many sequences.
    slowest_s : float
        Longest time for one of them.
    seconds : float
        Time for all.
    """

    items: int = 0
    accepted: int = 0
    sequences: int = 0
    slowest_s: float = 0.0
    seconds: float = 0.0


def run(
    target: Target,
    items: int,
    number: int,
    tell: Callable[[Result], None] = lambda _: None,
    *,
    shrink: bool = True,
) -> Result:
    """Feed at least so many items.

    Parameters
    ----------
    target : Target
        What is fed.
    items : int
        How many at least.
    number : int
        Seed: the same one feeds the same items.
    tell : callable
        Told the result so far, now and then.
    shrink : bool
        Whether a finding is shrunk: what is fed has to begin anew with each sequence for that.

    Raises
    ------
    Exception
        What the first finding is, its items shrunk and printed by hypothesis.
    """
    result = Result()
    begin = time.monotonic()

    def feed(some: Sequence[Any]) -> None:
        before = time.monotonic()
        accepted = target.feed(some)
        result.slowest_s = max(result.slowest_s, time.monotonic() - before)
        result.sequences += 1
        result.items += len(accepted)
        result.accepted += sum(accepted)

    while result.items < items:
        length = result.items / result.sequences if result.sequences else FIRST_GUESS
        wanted = math.ceil((items - result.items) / length)
        one = settings(
            max_examples=min(BATCH, wanted),
            database=None,
            report_multiple_bugs=False,
            deadline=None,
            phases=(Phase.generate, Phase.shrink) if shrink else (Phase.generate,),
            suppress_health_check=list(HealthCheck),
            print_blob=False,
        )(seed(number)(given(target.items)(feed)))
        one()
        number += 1
        result.seconds = time.monotonic() - begin
        tell(result)
    return result
