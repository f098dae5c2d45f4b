# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Whole revolutions, put together from blocks of any size.

A revolution is the N samples from one multiple of N to the next. Samples are known by their index,
so a lost block, a repeated one and one that comes too late are all seen.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

PHASE_GRID = 2.0**20
"""The phase at the start of a revolution is rounded to this many parts of a sample: rounding errors
of whoever sent it then have no part in the results."""

SYNCHRONOUS = 1e-9
"""Relative difference below which a phase increment is 2π/N."""

SAME_PHASE_SAMPLES = 1e-3
"""Phases that differ by less, in samples, are the same."""


class Timing(NamedTuple):
    """What the samples of a block share."""

    sample_period_s: float
    excitation_hz: float
    phase_increment_rad: float


class Revolution(NamedTuple):
    """N samples that begin at a multiple of N.

    Attributes
    ----------
    first_sample : int
        Index of the first sample.
    samples : ndarray, shape (channels, N)
        The samples.
    excitation_hz : float
        Excitation frequency at the last sample.
    phase_rad : float
        Phase of the eccentric at the first sample, in [0, 2π).
    synchronous : bool
        Whether the N samples are one revolution of the eccentric at one frequency.
    """

    first_sample: int
    samples: NDArray[np.float64]
    excitation_hz: float
    phase_rad: float
    synchronous: bool


@dataclass(frozen=True)
class Loss:
    """Samples are missing before the next revolution, or the stream began anew."""


class RevolutionCollector:
    """Turns blocks into revolutions.

    Parameters
    ----------
    channels : int
        Rows of the blocks.
    reach_samples : int
        A block that begins further back than this is a new stream (the sender was restarted), not a
        block that comes late.
    samples_per_revolution : int
        N.
    """

    def __init__(
        self,
        channels: int,
        reach_samples: int,
        samples_per_revolution: int = SAMPLES_PER_REVOLUTION,
    ) -> None:
        self._reach = reach_samples
        self._count = samples_per_revolution
        self._step = 2.0 * math.pi / samples_per_revolution
        self._samples = np.zeros((channels, samples_per_revolution))
        self._expected: int | None = None
        self._whole = False
        self._uniform = False
        self._timing: Timing | None = None
        self._phase = 0.0
        self._last_timing: Timing | None = None
        self._advance = 1.0

    def feed(
        self,
        first_sample: int,
        samples: Sequence[NDArray[np.generic]],
        timing: Timing,
        phase_rad: float,
    ) -> list[Revolution | Loss]:
        """Take one block and return what it completes.

        Samples that were already seen are ignored. An incomplete revolution is given up.

        Parameters
        ----------
        first_sample : int
            Index of the first sample.
        samples : sequence of ndarray, shape (n,)
            The samples of each channel.
        timing : Timing
            What they share.
        phase_rad : float
            Phase of the eccentric at the first sample.
        """
        found: list[Revolution | Loss] = []
        start = first_sample
        end = first_sample + len(samples[0])
        if end == start:
            return found
        if self._expected is None:
            self._whole = False
        elif start > self._expected or start < self._expected - self._reach:
            found.append(Loss())
            self._whole = False
        else:
            start = self._expected
            if end <= start:
                return found
        if timing != self._last_timing:
            self._last_timing = timing
            self._advance = self._advance_of(timing)
        count = self._count
        if start % count == 0 and end - start == count and start == first_sample:
            # What comes most: a block that is a revolution.
            self._begin(timing, phase_rad / self._step % count)
            whole = np.concatenate(samples, dtype=np.float64).reshape(self._samples.shape)
            found.append(self._revolution(start, timing, whole))
            start = end
        while start < end:
            offset = start % count
            stop = min(end, start - offset + count)
            phase = (phase_rad / self._step + (start - first_sample) * self._advance) % count
            if offset == 0:
                self._begin(timing, phase)
            elif self._whole:
                self._uniform = self._uniform and self._continues(timing, phase, offset)
            if self._whole:
                for row, channel in zip(self._samples, samples, strict=True):
                    row[offset : offset + stop - start] = channel[
                        start - first_sample : stop - first_sample
                    ]
                if stop % count == 0:
                    found.append(self._revolution(stop - count, timing, self._samples.copy()))
            start = stop
        self._expected = end
        return found

    def _begin(self, timing: Timing, phase: float) -> None:
        self._whole = True
        self._uniform = True
        self._timing = timing
        self._phase = round(phase * PHASE_GRID) / PHASE_GRID % self._count

    def _advance_of(self, timing: Timing) -> float:
        """Return the phase increment over that of N samples per revolution, exactly 1 when it is that."""
        advance = timing.phase_increment_rad / self._step
        return 1.0 if abs(advance - 1.0) < SYNCHRONOUS else advance

    def _continues(self, timing: Timing, phase: float, offset: int) -> bool:
        """Whether a block goes on with the revolution as it was begun."""
        apart = (phase - self._phase - offset * self._advance) % self._count
        return timing == self._timing and min(apart, self._count - apart) < SAME_PHASE_SAMPLES

    def _revolution(
        self, first_sample: int, timing: Timing, samples: NDArray[np.float64]
    ) -> Revolution:
        return Revolution(
            first_sample=first_sample,
            samples=samples,
            excitation_hz=timing.excitation_hz,
            phase_rad=self._phase * self._step,
            synchronous=self._uniform and self._advance == 1.0 and timing.excitation_hz > 0,
        )
