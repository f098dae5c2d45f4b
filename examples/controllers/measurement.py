# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a controller gets and gives: the roller's messages in, one `Measurement` a revolution, a `Command` out.

Nothing here needs ROS: a message is any object with the fields of its type, be it rclpy's or one read from a trace.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

N = 128
"""Samples in a revolution of the eccentric."""

REVOLUTIONS = 16
"""Revolutions of samples that a `Measurement` holds at most."""


@dataclass(frozen=True)
class Measurement:
    """What was measured up to the end of a revolution.

    Attributes
    ----------
    stamp_ns : int
        Time of the revolution's last sample.
    revolution : int
        Its number, from 0.
    cmv, rmv : float
        Meter values; NaN when there is none.
    lag_rad : float
        By which the drum's displacement lags the eccentric's force, in [0, 2π): π for a free drum, less over a
        spring; NaN when unknown.
    frequency_hz : float
        Excitation frequency.
    amplitude_m : float
        Nominal amplitude of the exciter, at the end of the revolution before.
    commanded_frequency_hz, commanded_amplitude_m : float
        What the exciter had been told, likewise.
    vertical : ndarray, shape (revolutions, 128)
        Vertical acceleration of the last whole revolutions, at most 16, m/s², up positive; none after a gap, or where
        128 samples are no revolution.
    phase_rad : float
        Phase of the eccentric where they begin; its vertical force goes with the sine. NaN when there are none.
    """

    stamp_ns: int
    revolution: int
    cmv: float
    rmv: float
    lag_rad: float
    frequency_hz: float
    amplitude_m: float
    commanded_frequency_hz: float
    commanded_amplitude_m: float
    vertical: NDArray[np.float64]
    phase_rad: float


@dataclass(frozen=True)
class Command:
    """What the roller is to do.

    Attributes
    ----------
    frequency_hz, amplitude_m : float
        Of the exciter.
    speed_m_s : float or None
        Of the travel, positive towards growing chainage; None leaves it alone.
    """

    frequency_hz: float
    amplitude_m: float
    speed_m_s: float | None = None


class Law(Protocol):
    """A controller. What it remembers is its own affair."""

    def update(self, measurement: Measurement) -> Command:
        """Answer a measurement, once a revolution."""
        ...


class Collector:
    """Makes measurements of messages, which between topics may come in any order.

    A measurement is complete when ``meter`` and the samples up to its last one are there, and a first
    ``exciter/state``. So that it does not depend on which message was quicker, the state is that of the revolution
    before.
    """

    def __init__(self) -> None:
        self._revolutions: deque[tuple[int, NDArray[np.float64]]] = deque(maxlen=4 * REVOLUTIONS)
        self._begun: list[NDArray[np.float64]] | None = None
        self._phase_rad = math.nan
        self._next_sample = 0
        self._states: deque[Any] = deque(maxlen=4 * REVOLUTIONS)
        self._meters: deque[Any] = deque(maxlen=4 * REVOLUTIONS)

    def acceleration(self, block: Any) -> list[Measurement]:
        """Take a block of ``drum/acceleration``, which reaches over no multiple of 128; return what it completes."""
        synchronous = abs(block.phase_increment * N / (2.0 * math.pi) - 1.0) < 1e-9
        if block.sequence != self._next_sample or not synchronous:
            self._revolutions.clear()
            self._begun = None
        if block.sequence % N == 0 and synchronous:
            self._begun = []
            self._phase_rad = block.eccentric_phase
        self._next_sample = block.sequence + len(block.vertical)
        if self._begun is not None:
            self._begun.append(np.asarray(block.vertical, dtype=np.float64))
            if self._next_sample % N == 0:
                self._revolutions.append((block.sequence // N, np.concatenate(self._begun)))
        return self._complete()

    def meter(self, meter: Any) -> list[Measurement]:
        """Take a value of ``meter`` and return what it completes."""
        self._meters.append(meter)
        return self._complete()

    def exciter_state(self, state: Any) -> list[Measurement]:
        """Take an ``exciter/state`` and return what it completes."""
        self._states.append(state)
        return self._complete()

    def _complete(self) -> list[Measurement]:
        complete = []
        while self._meters and self._states and self._meters[0].last_sample < self._next_sample:
            complete.append(self._measurement(self._meters.popleft()))
        return complete

    def _measurement(self, meter: Any) -> Measurement:
        revolution = meter.last_sample // N
        stamp_ns = nanoseconds(meter.header.stamp)
        # Where the samples are no revolution there are at least 10 times 128 of them in a second.
        earlier_ns = stamp_ns - round(1.5e9 / max(meter.excitation_frequency, 10.0))
        earlier = [it for it in self._states if nanoseconds(it.header.stamp) < earlier_ns]
        state = earlier[-1] if earlier else self._states[0]
        rows = [row for index, row in self._revolutions if index <= revolution][-REVOLUTIONS:]
        return Measurement(
            stamp_ns=stamp_ns,
            revolution=revolution,
            cmv=meter.cmv,
            rmv=meter.rmv,
            lag_rad=(math.pi - meter.fundamental_phase) % (2.0 * math.pi),
            frequency_hz=meter.excitation_frequency,
            amplitude_m=state.amplitude,
            commanded_frequency_hz=state.commanded_frequency,
            commanded_amplitude_m=state.commanded_amplitude,
            vertical=np.array(rows).reshape(-1, N),
            phase_rad=self._phase_rad if rows else math.nan,
        )


def nanoseconds(stamp: Any) -> int:
    """Return a stamp in ns since the epoch."""
    return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)
