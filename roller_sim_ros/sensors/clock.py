# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The sensor's own clock: it runs a little fast or slow, and the session's time is not its time."""

from __future__ import annotations

import math

from roller_sim_ros.session.block import Block

SAMPLES = 128
TWO_PI = 2.0 * math.pi


class Clock:
    """Session time and sensor time of one revolution; both run evenly within it.

    Everything is reckoned from the revolution's first sample, so that the size of the blocks has no part in it.

    Parameters
    ----------
    skew_ppm : float
        How much faster than the session's time it runs, parts per million.

    Attributes
    ----------
    revolution : int
        The revolution, −1 before the first.
    start_s : float
        Its beginning by session time.
    ahead_s : float
        Sensor time less session time at its beginning.
    skew : float
        Growth of that with time in this revolution.
    sample_period_s : float
        The session's sample period in this revolution.
    phase_rad : float
        Phase of the eccentric at its beginning.
    """

    def __init__(self, skew_ppm: float = 0.0) -> None:
        self._skew_ppm = skew_ppm
        self.revolution = -1
        self.start_s = self.ahead_s = 0.0
        self.skew = 0.0
        self.sample_period_s = 0.0
        self.phase_rad = 0.0

    def begin(self, block: Block, skew_ppm: float = 0.0) -> bool:
        """Move on to the revolution that a block begins with; return whether it does begin one.

        Parameters
        ----------
        block : Block
            The next block.
        skew_ppm : float
            Beside the clock's own.
        """
        if block.first_sample % SAMPLES:
            return False
        self.ahead_s += (block.time_s - self.start_s) * self.skew
        self.start_s = block.time_s
        self.skew = (self._skew_ppm + skew_ppm) * 1e-6
        self.revolution = block.first_sample // SAMPLES
        self.sample_period_s = block.sample_period_s
        self.phase_rad = block.eccentric_phase_rad
        return True

    def time_s(self, offset: int) -> float:
        """Return the session time of the revolution's sample `offset`."""
        return self.start_s + offset * self.sample_period_s

    def sensor_time_s(self, offset: int) -> float:
        """Return the sensor time of the revolution's sample `offset`."""
        return self.time_s(offset) + (self.ahead_s + offset * self.sample_period_s * self.skew)
