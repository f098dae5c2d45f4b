# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""When the sensor takes its samples: with the eccentric, or by a clock of its own."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from roller_sim_ros.sensors.clock import SAMPLES, Clock
from roller_sim_ros.sensors.kernels import HALF_WIDTH, interpolate
from roller_sim_ros.sensors.stage import Signals
from roller_sim_ros.session.block import Block

Array = NDArray[np.float64]
TWO_PI = 2.0 * math.pi
MOST_JITTER = 0.45
"""Of a period: beyond that samples would come in the wrong order."""


class Instants(NamedTuple):
    """When samples of one revolution were taken; fields as in `Reading`."""

    first_sample: int
    time_s: float
    sample_period_s: float
    excitation_hz: float
    eccentric_phase_rad: float
    phase_increment_rad: float
    revolution: int
    sensor_time_s: float


class Synchronous:
    """The model's own samples: 128 per revolution, each as soon as it is there."""

    def take(
        self, block: Block, signals: Signals, clock: Clock, *, begins: bool
    ) -> Iterator[tuple[Instants, Signals]]:
        """Yield the block."""
        del begins
        instants = Instants(
            block.first_sample,
            block.time_s,
            block.sample_period_s,
            block.excitation_hz,
            block.eccentric_phase_rad,
            block.phase_increment_rad,
            clock.revolution,
            clock.sensor_time_s(block.first_sample % SAMPLES),
        )
        yield instants, signals


@dataclass
class _Revolution:
    """Samples of one revolution that are still to be taken.

    Attributes
    ----------
    number : int
        The revolution.
    next_sample : int
        The sensor's index of the next one.
    times_s : ndarray
        When each is due, without jitter.
    places : ndarray
        Where each is, with jitter, in model samples since the start of the revolution.
    sensor_times_s : ndarray
        The same by the sensor's clock.
    excitation_hz, start_s, phase_rad, omega : float
        Frequency, beginning, phase there, rad, and angular frequency of the eccentric, rad/s.
    """

    number: int
    next_sample: int
    times_s: Array
    places: Array
    sensor_times_s: Array
    excitation_hz: float
    start_s: float
    phase_rad: float
    omega: float


class FixedRate:
    """Samples at k/rate by the sensor's clock, between the model's by interpolation of the low-passed signal.

    What the low-pass lets through above half the rate folds back as it does in the sensor; what interpolation
    would add lies below 1e-3 of the signal. A sample comes out once the model is 12 samples further.

    Parameters
    ----------
    rate_hz : float
        By the sensor's clock.
    jitter_s : float
        Standard deviation of the instants.
    stream : callable
        Random numbers of a purpose.
    """

    def __init__(self, rate_hz: float, jitter_s: float, stream: Callable[[str], Generator]) -> None:
        self._period_s = 1.0 / rate_hz
        self._rate_hz = rate_hz
        self._jitter_s = jitter_s
        self._random = stream("jitter")
        self._next_sample = 0
        self._waiting: list[_Revolution] = []
        # The last samples of the model: of both axes, those before the first one all like it.
        self._kept = np.zeros((2, 0))
        self._kept_from = 0

    def take(
        self, block: Block, signals: Signals, clock: Clock, *, begins: bool
    ) -> Iterator[tuple[Instants, Signals]]:
        """Yield the samples that can be made after a block, revolution by revolution."""
        if begins:
            self._waiting.append(self._plan(block, clock))
        self._keep(block, signals)
        end = block.first_sample + len(block)
        for revolution in self._waiting:
            last = end - SAMPLES * revolution.number - HALF_WIDTH - 1
            ready = int(np.searchsorted(revolution.places, last, side="right"))
            if ready:
                yield self._taken(revolution, ready)
        self._waiting = [item for item in self._waiting if len(item.places)]

    def _plan(self, block: Block, clock: Clock) -> _Revolution:
        """Return the samples of the revolution that begins."""
        rate = 1.0 + clock.skew
        duration_s = SAMPLES * block.sample_period_s
        begin_s = clock.sensor_time_s(0)
        end_s = begin_s + duration_s * rate
        count = max(0, math.ceil(end_s * self._rate_hz) - self._next_sample)
        numbers = np.arange(self._next_sample, self._next_sample + count, dtype=np.float64)
        sensor_times_s = numbers * self._period_s
        since_s = (sensor_times_s - begin_s) / rate
        jitter_s = np.zeros(count)
        if self._jitter_s:
            most = MOST_JITTER * self._period_s
            jitter_s = np.clip(self._jitter_s * self._random.standard_normal(count), -most, most)
        plan = _Revolution(
            number=clock.revolution,
            next_sample=self._next_sample,
            times_s=clock.start_s + since_s,
            places=(since_s + jitter_s) / block.sample_period_s,
            sensor_times_s=sensor_times_s,
            excitation_hz=block.excitation_hz,
            start_s=clock.start_s,
            phase_rad=clock.phase_rad,
            omega=block.phase_increment_rad / block.sample_period_s,
        )
        self._next_sample += count
        return plan

    def _keep(self, block: Block, signals: Signals) -> None:
        axes = np.stack([signals.vertical, signals.horizontal])
        if not self._kept.shape[1]:
            self._kept = np.repeat(axes[:, :1], 2 * HALF_WIDTH, axis=1)
            self._kept_from = block.first_sample - 2 * HALF_WIDTH
        self._kept = np.concatenate([self._kept, axes], axis=1)
        surplus = self._kept.shape[1] - 2 * SAMPLES - 4 * HALF_WIDTH
        if surplus > 0:
            self._kept = self._kept[:, surplus:]
            self._kept_from += surplus

    def _taken(self, revolution: _Revolution, count: int) -> tuple[Instants, Signals]:
        """Return the first samples that are left of a revolution, and take them out of it."""
        offset = SAMPLES * revolution.number - self._kept_from
        axes = np.empty((2, count))
        for samples, out in zip(self._kept, axes, strict=True):
            interpolate(np.ascontiguousarray(samples), offset, revolution.places[:count], out)
        first_s = float(revolution.times_s[0])
        instants = Instants(
            first_sample=revolution.next_sample,
            time_s=first_s,
            sample_period_s=self._period_s,
            excitation_hz=revolution.excitation_hz,
            eccentric_phase_rad=(
                revolution.phase_rad + (first_s - revolution.start_s) * revolution.omega
            )
            % TWO_PI,
            phase_increment_rad=revolution.omega * self._period_s,
            revolution=revolution.number,
            sensor_time_s=float(revolution.sensor_times_s[0]),
        )
        revolution.next_sample += count
        revolution.times_s = revolution.times_s[count:]
        revolution.places = revolution.places[count:]
        revolution.sensor_times_s = revolution.sensor_times_s[count:]
        return instants, Signals(axes[0], axes[1], self._period_s)
