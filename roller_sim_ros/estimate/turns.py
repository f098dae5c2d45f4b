# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Samples of any spacing laid on revolutions of the eccentric: N samples each, from phase zero to phase zero."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]

ON_GRID = 1e-3
"""Part of a sample by which samples may miss the grid and are taken as they are."""

BESIDE = 4
"""Samples on either side of a revolution that its interpolation needs."""

JUMP_TURNS = 0.02
"""By which the phase may differ from where the last samples led to: beyond that something is missing."""


@dataclass(frozen=True)
class Turn:
    """One revolution.

    Attributes
    ----------
    time_s : float
        Of phase zero at its start.
    excitation_hz : float
        Its frequency: that stated with its samples, else from their times.
    amplitude_m : float
        Nominal amplitude of the exciter, NaN when unknown.
    vertical : ndarray, shape (N,)
        Vertical acceleration, m/s².
    follows : bool
        Whether it begins where the one before ended.
    """

    time_s: float
    excitation_hz: float
    amplitude_m: float
    vertical: Array
    follows: bool


class TurnCollector:
    """Makes revolutions of samples that come bit by bit.

    Samples on the grid of N per revolution are taken as they are, others are interpolated by a cubic spline over the
    phase.

    Parameters
    ----------
    samples_per_revolution : int
        N.
    """

    def __init__(self, samples_per_revolution: int) -> None:
        self._count = samples_per_revolution
        self._begin()

    def _begin(self) -> None:
        self._times: list[Array] = []
        self._turns: list[Array] = []
        self._values: list[Array] = []
        self._last_turns = math.nan
        self._slope = 0.0
        self._next = math.nan
        self._follows = False

    def interrupt(self) -> None:
        """Give up the revolution that is under way: what comes next does not follow."""
        self._begin()

    def feed(
        self,
        times_s: Array,
        turns: Array,
        vertical: NDArray[np.floating],
        *,
        excitation_hz: float,
        amplitude_m: float,
    ) -> Iterator[Turn]:
        """Take samples in a row and yield the revolutions that they complete.

        Parameters
        ----------
        times_s : ndarray, shape (n,)
            Times.
        turns : ndarray, shape (n,)
            Phases of the eccentric in revolutions, rising; a whole number of revolutions does not matter.
        vertical : ndarray, shape (n,)
            Vertical acceleration, m/s².
        excitation_hz : float
            Frequency as stated; NaN when it is to be found from the phases.
        amplitude_m : float
            Nominal amplitude.
        """
        if not len(times_s):
            return
        if not math.isnan(self._last_turns):
            expected = self._last_turns + self._slope
            off = turns[0] - expected
            off -= round(off)
            if abs(off) > JUMP_TURNS:
                self._begin()
            else:
                turns = turns + (round(expected + off - turns[0]))
        if math.isnan(self._next):
            self._next = float(math.ceil(turns[0] - ON_GRID / self._count))
        if len(turns) > 1:
            self._slope = float(turns[-1] - turns[-2])
        elif not math.isnan(self._last_turns):
            self._slope = float(turns[0] - self._last_turns)
        self._last_turns = float(turns[-1])
        self._times.append(times_s)
        self._turns.append(turns)
        self._values.append(np.asarray(vertical, dtype=np.float64))
        yield from self._completed(excitation_hz, amplitude_m)

    def _completed(self, excitation_hz: float, amplitude_m: float) -> Iterator[Turn]:
        """Yield what is complete and forget its samples."""
        step = 1.0 / self._count
        while self._last_turns >= self._next + 1.0 - step - ON_GRID * step:
            times, turns, values = (
                np.concatenate(part) for part in (self._times, self._turns, self._values)
            )
            self._times, self._turns, self._values = [times], [turns], [values]
            first = int(np.searchsorted(turns, self._next - ON_GRID * step))
            place = (turns[first : first + self._count] - self._next) * self._count
            on_grid = len(place) == self._count and bool(
                np.all(np.abs(place - np.arange(self._count)) < ON_GRID)
            )
            if on_grid:
                vertical = values[first : first + self._count].copy()
            else:
                last = int(np.searchsorted(turns, self._next + 1.0))
                if len(turns) < last + BESIDE:
                    return
                near = slice(max(0, first - BESIDE), last + BESIDE)
                grid = self._next + np.arange(self._count) * step
                vertical = CubicSpline(turns[near], values[near])(grid)
            begins = times[first] if on_grid else np.interp(self._next, turns, times)
            frequency = excitation_hz
            if math.isnan(frequency):
                end = min(first + self._count, len(turns)) - 1
                frequency = (turns[end] - turns[first]) / (times[end] - times[first])
            yield Turn(float(begins), float(frequency), amplitude_m, vertical, self._follows)
            self._follows = True
            self._next += 1.0
            kept = max(0, int(np.searchsorted(turns, self._next - ON_GRID * step)) - BESIDE)
            self._times, self._turns, self._values = [times[kept:]], [turns[kept:]], [values[kept:]]
