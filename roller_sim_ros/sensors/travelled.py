# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where the roller is at any time of a revolution, and when a sensor of a fixed rate asks."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from roller_sim_ros.sensors.clock import SAMPLES, Clock
from roller_sim_ros.session.block import Block
from roller_sim_ros.site import Position

ROUNDING = 1e-9
"""Of a period: a moment that is so little before the end of a block is the next one's."""


class Station(NamedTuple):
    """A moment at which a sensor of the travel measures.

    Attributes
    ----------
    number : int
        Measurements so far.
    time_s : float
        Since the start of the session.
    revolution : int
        The session's.
    chainage_m, speed_m_s : float
        True position along the lane and travel speed.
    """

    number: int
    time_s: float
    revolution: int
    chainage_m: float
    speed_m_s: float


class Stations:
    """Yields the moments k/rate, with the true position between the beginnings of revolutions.

    Parameters
    ----------
    rate_hz : float
        Measurements per second.
    """

    def __init__(self, rate_hz: float) -> None:
        self._rate_hz = rate_hz
        self._next = 0
        self._clock = Clock()
        self._position = Position()

    def take(self, block: Block, position: Position) -> Iterator[Station]:
        """Yield the moments in a block.

        Parameters
        ----------
        block : Block
            The next one.
        position : Position
            Where its revolution began.
        """
        if self._clock.begin(block):
            self._position = position
        clock = self._clock
        end = block.first_sample % SAMPLES + len(block)
        before = math.ceil(clock.time_s(end) * self._rate_hz - ROUNDING)
        for number in range(self._next, before):
            time_s = number / self._rate_hz
            way_m = self._position.speed_m_s * (time_s - clock.start_s)
            yield Station(
                number,
                time_s,
                clock.revolution,
                self._position.chainage_m + way_m,
                self._position.speed_m_s,
            )
        self._next = max(self._next, before)
