# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A sensor_msgs/Imu stream, one message a sample, as revolutions of the eccentric.

An Imu message tells neither phase nor frequency. It can be evaluated exactly where its rate is a whole
number of samples per revolution of an excitation that stays constant; where it is not, that is said and
nothing is guessed. The phase of the eccentric is unknown: it is taken as zero at the first sample, so the
amplitudes are right and the phase of the fundamental means nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.bag import BagError
from roller_sim_ros.analysis.samples import NANOSECONDS, Piece, stamp_ns

PROBE_SAMPLES = 8192
"""Samples at the start from which rate and frequency are found."""

FEWEST_SAMPLES = 512
FEWEST_PER_REVOLUTION = 16
LOWEST_HZ, HIGHEST_HZ = 5.0, 100.0
"""Where an excitation frequency is looked for."""

WHOLE = 6e-4
"""Relative deviation from a whole number of samples per revolution that is taken for none: over 16
revolutions it turns the phase by 1 % of a revolution, and RMV is off by less than 0.5."""

SPACING = 0.25
"""Deviation of a stamp from the equidistant ones, in sample periods, that is taken for rounding."""

CHECKED_REVOLUTIONS = 16
"""Revolutions between two checks of the mean rate."""


@dataclass(frozen=True)
class ImuRate:
    """Rate of an Imu stream.

    Attributes
    ----------
    sample_period_s : float
        Time from sample to sample.
    excitation_hz : float
        Excitation frequency, such that `samples_per_revolution` is exact.
    samples_per_revolution : int
        Whole number of samples per revolution of the eccentric.
    """

    sample_period_s: float
    excitation_hz: float
    samples_per_revolution: int


def find_rate(
    stamps_ns: Sequence[int], vertical: Sequence[float], excitation_hz: float | None = None
) -> ImuRate:
    """Find rate and excitation frequency from the first samples of a stream.

    Parameters
    ----------
    stamps_ns : sequence of int
        Time stamps.
    vertical : sequence of float
        Vertical acceleration, m/s²; gravity does not matter.
    excitation_hz : float, optional
        Excitation frequency; found from the spectrum when left out.

    Raises
    ------
    BagError
        If the samples are too few or not equidistant, if nothing vibrates, or if the rate is not a whole
        number of samples per revolution.
    """
    if len(stamps_ns) < FEWEST_SAMPLES:
        raise BagError(
            f"{len(stamps_ns)} Imu messages are too few: at least {FEWEST_SAMPLES} are needed"
        )
    stamps = np.asarray(stamps_ns, dtype=np.int64)
    steps = np.diff(stamps) / NANOSECONDS
    period_s = float(np.median(steps))
    if not period_s > 0.0:
        raise BagError("the Imu stamps do not advance")
    counts = np.rint(steps / period_s)
    if np.any(np.abs(steps / period_s - counts) > SPACING):
        raise BagError(
            f"the Imu stamps are not equidistant (median {period_s * 1e3:.4g} ms, between "
            f"{steps.min() * 1e3:.4g} and {steps.max() * 1e3:.4g} ms): revolutions cannot be told apart"
        )
    whole = np.flatnonzero(counts != 1)
    # The longest stretch without a gap.
    bounds = np.concatenate([[-1], whole, [len(counts)]])
    longest = int(np.argmax(np.diff(bounds)))
    first, last = int(bounds[longest]) + 1, int(bounds[longest + 1])
    samples = np.asarray(vertical, dtype=np.float64)[first : last + 1]
    if len(samples) < FEWEST_SAMPLES:
        raise BagError(f"no {FEWEST_SAMPLES} Imu messages in a row are without a gap")
    period_s = float(stamps[last] - stamps[first]) / NANOSECONDS / (last - first)
    measured = _frequency(samples, period_s, excitation_hz)
    frequency = measured if excitation_hz is None else excitation_hz
    per_revolution = 1.0 / (period_s * frequency)
    count = round(per_revolution)
    if abs(per_revolution - count) > WHOLE * per_revolution or count < FEWEST_PER_REVOLUTION:
        raise BagError(
            f"the Imu rate of {1.0 / period_s:.2f} Hz is {per_revolution:.3f} samples per revolution at "
            f"{frequency:.3f} Hz; it must be a whole number of at least {FEWEST_PER_REVOLUTION} (the "
            "simulated roller has 128): other rates cannot be evaluated by orders"
        )
    if abs(measured - frequency) > WHOLE * frequency:
        raise BagError(
            f"the excitation is at {measured:.3f} Hz, not at the {frequency:.3f} Hz that were given"
        )
    return ImuRate(period_s, 1.0 / (period_s * count), count)


def _frequency(samples: NDArray[np.float64], period_s: float, near_hz: float | None) -> float:
    """Return the strongest frequency, near `near_hz` when it is given."""
    vibration = samples - samples.mean()
    if not np.max(np.abs(vibration)) > 1e-3:
        raise BagError(
            "the Imu stream does not vibrate at its start: no excitation frequency is found"
        )
    padded = 4 * len(vibration)
    spectrum = np.abs(np.fft.rfft(vibration * np.hanning(len(vibration)), padded))
    frequencies = np.fft.rfftfreq(padded, period_s)
    low, high = (LOWEST_HZ, HIGHEST_HZ) if near_hz is None else (0.9 * near_hz, 1.1 * near_hz)
    looked_at = (frequencies >= low) & (frequencies <= min(high, 0.45 / period_s))
    if not looked_at.any():
        raise BagError(
            f"a rate of {1.0 / period_s:.4g} Hz is too low for an excitation of {low:.4g} Hz"
        )
    rough = float(frequencies[np.argmax(np.where(looked_at, spectrum, 0.0))])
    # The phase between the two halves gives what is missing to the exact frequency.
    half = int(int(len(vibration) * period_s * rough / 2) / (period_s * rough))
    turns = np.exp(-2j * math.pi * rough * period_s * np.arange(half)) * np.hanning(half)
    advance = np.exp(-2j * math.pi * rough * period_s * half)
    first = np.sum(vibration[:half] * turns)
    second = np.sum(vibration[half : 2 * half] * turns) * advance
    drift = float(np.angle(second * np.conj(first)))
    return rough + drift / (2.0 * math.pi * half * period_s)


class ImuReader:
    """Turns Imu messages into pieces of up to a revolution.

    Parameters
    ----------
    rate : ImuRate
        As `find_rate` found it.
    """

    def __init__(self, rate: ImuRate) -> None:
        self.rate = rate
        self._increment = 2.0 * math.pi / rate.samples_per_revolution
        self._index = 0
        self._stamp: int | None = None
        self._checked = (0, 0)
        self._first = 0
        self._first_stamp = 0
        self._vertical: list[float] = []
        self._horizontal: list[float] = []

    def read(self, message: Any) -> Iterator[Piece]:
        """Take one message; yield the samples before it when it completes or interrupts a piece.

        Raises
        ------
        BagError
            If the stamps change their spacing: the excitation frequency does.
        """
        stamp = stamp_ns(message)
        if self._stamp is not None:
            steps = (stamp - self._stamp) / NANOSECONDS / self.rate.sample_period_s
            count = round(steps)
            if abs(steps - count) > SPACING * max(1.0, abs(steps)):
                raise self._spacing_changes(steps * self.rate.sample_period_s)
            if count != 1:
                yield from self.flush()
            self._index += count
            self._check_rate(stamp)
        else:
            self._checked = (0, stamp)
        if not self._vertical:
            self._first, self._first_stamp = self._index, stamp
        self._stamp = stamp
        self._vertical.append(float(message.linear_acceleration.z))
        self._horizontal.append(float(message.linear_acceleration.x))
        if (self._index + 1) % self.rate.samples_per_revolution == 0:
            yield from self.flush()

    def _check_rate(self, stamp: int) -> None:
        """Compare the mean period with the one found at the start, some revolutions at a time."""
        index, before = self._checked
        count = self._index - index
        if count >= CHECKED_REVOLUTIONS * self.rate.samples_per_revolution:
            period_s = (stamp - before) / NANOSECONDS / count
            if abs(period_s / self.rate.sample_period_s - 1.0) > WHOLE:
                raise self._spacing_changes(period_s)
            self._checked = (self._index, stamp)

    def _spacing_changes(self, period_s: float) -> BagError:
        return BagError(
            f"the Imu stamps change their spacing from {self.rate.sample_period_s * 1e3:.6g} to "
            f"{period_s * 1e3:.6g} ms after {self._index + 1} samples: the excitation does not stay constant, "
            "and an Imu stream does not tell its phase"
        )

    def flush(self) -> Iterator[Piece]:
        """Yield what is held back."""
        if self._vertical:
            per_revolution = self.rate.samples_per_revolution
            yield Piece(
                first_sample=self._first,
                stamp_ns=self._first_stamp,
                sample_period_s=self.rate.sample_period_s,
                excitation_hz=self.rate.excitation_hz,
                phase_rad=self._first % per_revolution * self._increment,
                phase_increment_rad=self._increment,
                vertical=np.array(self._vertical, dtype=np.float32),
                horizontal=np.array(self._horizontal, dtype=np.float32),
                specific_force=True,
            )
            self._vertical, self._horizontal = [], []
