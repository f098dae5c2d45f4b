# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The last settled revolutions of a bag, kept for the settled values and the plot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.recent import RecentSamples
from roller_sim_ros.meters import SUMMARY_REVOLUTIONS

TRUTH_CHANNELS = ("soil_force", "drum_height", "contact_state")
SPARE_REVOLUTIONS = 8
"""Revolutions kept beyond those of the excerpt: other topics may lag a little."""


@dataclass(frozen=True)
class Excerpt:
    """Whole revolutions in a row at one frequency.

    Attributes
    ----------
    first_sample : int
        Index of the first sample.
    samples_per_revolution : int
        Samples in one revolution.
    excitation_hz : float
        Excitation frequency.
    vertical, horizontal : ndarray, shape (n,)
        Acceleration as delivered, m/s².
    soil_force, drum_height : ndarray, shape (n,), or None
        Truth where the bag holds it: N, and m over the untouched surface.
    contact_state : ndarray of uint8, shape (n,), or None
        LOADING, UNLOADING or AIR.
    """

    first_sample: int
    samples_per_revolution: int
    excitation_hz: float
    vertical: NDArray[np.float64]
    horizontal: NDArray[np.float64]
    soil_force: NDArray[np.float64] | None
    drum_height: NDArray[np.float64] | None
    contact_state: NDArray[np.uint8] | None

    @property
    def revolutions(self) -> int:
        """Revolutions that it holds."""
        return len(self.vertical) // self.samples_per_revolution


class ExcerptKeeper:
    """Holds the latest samples until it is known which of them are the last settled ones.

    Parameters
    ----------
    samples_per_revolution : int
        Samples in one revolution.
    """

    def __init__(self, samples_per_revolution: int) -> None:
        self._count = samples_per_revolution
        capacity = (SUMMARY_REVOLUTIONS + SPARE_REVOLUTIONS) * samples_per_revolution
        self.acceleration = RecentSamples(2, capacity)
        self.truth = RecentSamples(len(TRUTH_CHANNELS), capacity)
        self._end = -1
        self._revolutions = 0
        self._excitation_hz = 0.0
        self._kept: Excerpt | None = None

    def settled(self, last_sample: int, revolutions: int, excitation_hz: float) -> None:
        """Take note that so many revolutions up to a sample are settled."""
        self._end = last_sample + 1
        self._revolutions = min(revolutions, SUMMARY_REVOLUTIONS)
        self._excitation_hz = excitation_hz

    def interrupted(self) -> None:
        """Take the excerpt before its samples are overwritten: what follows is not settled."""
        if self._end >= 0:
            self._kept = self._read()
            self._end = -1

    def excerpt(self) -> Excerpt | None:
        """Return the last settled revolutions, an even number; None if there were none."""
        self.interrupted()
        return self._kept

    def _read(self) -> Excerpt | None:
        for revolutions in range(self._revolutions - self._revolutions % 2, 0, -2):
            count = revolutions * self._count
            first = self._end - count
            acceleration = self.acceleration.read(first, count)
            if acceleration is None:
                continue
            truth = self.truth.read(first, count)
            return Excerpt(
                first_sample=first,
                samples_per_revolution=self._count,
                excitation_hz=self._excitation_hz,
                vertical=acceleration[0],
                horizontal=acceleration[1],
                soil_force=None if truth is None else truth[0],
                drum_height=None if truth is None else truth[1],
                contact_state=None if truth is None else truth[2].astype(np.uint8),
            )
        return self._kept
