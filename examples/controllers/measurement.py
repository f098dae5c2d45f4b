"""What a controller gets and gives: the roller's messages in, one `Measurement` a revolution, a `Command` out.

Nothing here needs ROS: a message is any object with the fields of its type, be it rclpy's or one read from a trace.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters.revolutions import Loss, RevolutionCollector, Timing

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
        self._collector = RevolutionCollector(1, REVOLUTIONS * N)
        self._revolutions: deque[NDArray[np.float64]] = deque(maxlen=REVOLUTIONS)
        self._phase_rad = np.nan
        self._next_sample = 0
        self._begins_ns = 0
        self._states: deque[Any] = deque(maxlen=8)
        self._meter: Any = None

    def acceleration(self, block: Any) -> Measurement | None:
        """Take a block of ``drum/acceleration``."""
        timing = Timing(block.sample_period, block.excitation_frequency, block.phase_increment)
        samples = np.asarray(block.vertical, dtype=np.float64)
        for item in self._collector.feed(block.sequence, [samples], timing, block.eccentric_phase):
            if isinstance(item, Loss) or not item.synchronous:
                self._revolutions.clear()
                self._phase_rad = np.nan
            else:
                self._revolutions.append(item.samples[0].copy())
                self._phase_rad = item.phase_rad
        self._next_sample = block.sequence + len(samples)
        if block.sequence % N == 0:
            self._begins_ns = nanoseconds(block.header.stamp)
        return self._complete()

    def meter(self, meter: Any) -> Measurement | None:
        """Take a value of ``meter``."""
        self._meter = meter
        return self._complete()

    def exciter_state(self, state: Any) -> Measurement | None:
        """Take an ``exciter/state``."""
        self._states.append(state)
        return self._complete()

    def _complete(self) -> Measurement | None:
        meter = self._meter
        if meter is None or not self._states or self._next_sample <= meter.last_sample:
            return None
        self._meter = None
        half_ns = round(0.5e9 / max(meter.excitation_frequency, 10.0))
        earlier = [
            it for it in self._states if nanoseconds(it.header.stamp) < self._begins_ns - half_ns
        ]
        state = earlier[-1] if earlier else self._states[0]
        return Measurement(
            stamp_ns=nanoseconds(meter.header.stamp),
            revolution=meter.last_sample // N,
            cmv=meter.cmv,
            rmv=meter.rmv,
            lag_rad=(np.pi - meter.fundamental_phase) % (2.0 * np.pi),
            frequency_hz=meter.excitation_frequency,
            amplitude_m=state.amplitude,
            commanded_frequency_hz=state.commanded_frequency,
            commanded_amplitude_m=state.commanded_amplitude,
            vertical=np.array(self._revolutions).reshape(-1, N),
            phase_rad=self._phase_rad,
        )


def nanoseconds(stamp: Any) -> int:
    """Return a stamp in ns since the epoch."""
    return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)
