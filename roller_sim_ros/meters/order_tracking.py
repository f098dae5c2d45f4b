# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Samples of a fixed rate laid on the angle of the eccentric, so that a meter in orders can read them.

A sensor with a sample rate of its own takes no whole number of samples per revolution. Its messages tell the phase of
the eccentric, which turns evenly in each revolution; at 128 equal angles of it the signal is interpolated by a windowed
sinc, good up to three quarters of the Nyquist frequency.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.sensors.kernels.interpolation import HALF_WIDTH, interpolate

TURN = 2.0 * math.pi
ROUNDING = 1e-6
"""Of a place, in samples."""

NEAR = 0.5
"""Places that are nearer, in samples, are the same but for the clock's error."""

REACH_SAMPLES = 100_000
"""A block that begins further back than this is a new stream, not one that comes late."""


@dataclass(frozen=True)
class TrackedRevolution:
    """A revolution at equal angles.

    Attributes
    ----------
    number : int
        Consecutive, unless a revolution is missing before it.
    samples : ndarray, shape (samples_per_revolution,)
        From phase 0 on.
    excitation_hz : float
        Excitation frequency.
    last_sample : int
        Index of the sensor's last sample before the revolution ends.
    clipped : bool
        Whether the sensor clipped some of it.
    """

    number: int
    samples: NDArray[np.float64]
    excitation_hz: float
    last_sample: int
    clipped: bool


@dataclass
class _Begun:
    """A revolution that is not complete yet; places are indices of the sensor's samples, between them too."""

    number: int
    start: float
    length: float
    excitation_hz: float
    clipped: bool

    @property
    def end(self) -> float:
        return self.start + self.length


class OrderTracker:
    """Turns blocks of a fixed sample rate into revolutions.

    A revolution comes out once the sensor is 12 samples further. One of which samples are missing does not.

    Parameters
    ----------
    samples_per_revolution : int
        Angles per revolution.
    """

    def __init__(self, samples_per_revolution: int = SAMPLES_PER_REVOLUTION) -> None:
        self._count = samples_per_revolution
        self._kept = np.zeros(0)
        self._kept_from = 0
        self._expected: int | None = None
        self._begun: list[_Begun] = []
        self._number = 0
        self._start = self._end = math.nan

    def feed(
        self,
        first_sample: int,
        vertical: NDArray[np.floating],
        excitation_hz: float,
        eccentric_phase_rad: float,
        phase_increment_rad: float,
        clipped: int = 0,
    ) -> list[TrackedRevolution]:
        """Take one block and return the revolutions that can be made now.

        Parameters
        ----------
        first_sample : int
            Index of the first sample, as the sensor counts.
        vertical : ndarray, shape (n,)
            Acceleration, m/s².
        excitation_hz : float
            Of the block, above 0.
        eccentric_phase_rad : float
            Phase of the eccentric at the first sample.
        phase_increment_rad : float
            Phase from sample to sample, above 0.
        clipped : int
            How many readings of the block the sensor clipped.
        """
        start = self._joined(first_sample, vertical)
        if start is None:
            return []
        # Places where revolutions begin. By a clock that runs off, the next one seems to begin a little before the last
        # sample of this; where it does its own block says.
        length = TURN / phase_increment_rad
        place = first_sample - eccentric_phase_rad / phase_increment_rad
        end = first_sample + len(vertical)
        while place <= end - 1:
            if place > start - 1 - NEAR and (place <= start or place <= end - 1 - NEAR):
                self._begin(place, length, excitation_hz)
            place += length
        if clipped:
            for item in self._begun:
                item.clipped = item.clipped or item.end > start
        return self._made(end)

    def _joined(self, first_sample: int, vertical: NDArray[np.floating]) -> int | None:
        """Keep what is new of a block; return the index of its first new sample, None without any."""
        expected, end = self._expected, first_sample + len(vertical)
        start = first_sample
        if expected is not None and expected - REACH_SAMPLES <= first_sample <= expected:
            start = expected
            if end <= start:
                return None
        else:
            if expected is not None:
                self._number += 1
            self._begun.clear()
            self._kept = np.zeros(0)
            self._kept_from = start
            self._start = self._end = math.nan
        new = np.asarray(vertical[start - first_sample :], dtype=np.float64)
        self._kept = np.concatenate([self._kept, new])
        self._expected = end
        return start

    def _begin(self, place: float, length: float, excitation_hz: float) -> None:
        if abs(place - self._start) < NEAR:
            return
        if abs(place - self._end) > NEAR:
            # The phase jumped.
            self._begun.clear()
            self._number += 1
        self._begun.append(_Begun(self._number, place, length, excitation_hz, clipped=False))
        self._number += 1
        self._start, self._end = place, place + length

    def _made(self, end: int) -> list[TrackedRevolution]:
        """Return the revolutions whose samples are all there, and forget what is needed no more."""
        found = []
        while self._begun and self._begun[0].end + HALF_WIDTH < end:
            item = self._begun.pop(0)
            base = math.floor(item.start)
            if base - HALF_WIDTH + 1 < self._kept_from:
                # The very first one: what comes before it is not known.
                continue
            angles = np.arange(self._count, dtype=np.float64)
            places = angles * (item.length / self._count) + (item.start - base)
            samples = np.empty(self._count)
            interpolate(self._kept, base - self._kept_from, places, samples)
            last = math.ceil(item.end - ROUNDING) - 1
            found.append(
                TrackedRevolution(item.number, samples, item.excitation_hz, last, item.clipped)
            )
        oldest = math.floor(self._begun[0].start) if self._begun else end
        surplus = oldest - 2 * HALF_WIDTH - self._kept_from
        if surplus > 0:
            self._kept = self._kept[surplus:]
            self._kept_from += surplus
        return found
