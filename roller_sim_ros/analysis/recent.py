# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The latest samples of a stream, found again by their index."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


class RecentSamples:
    """A ring of the latest samples of some channels.

    Parameters
    ----------
    channels : int
        Values per sample.
    capacity : int
        Samples that are kept.
    """

    def __init__(self, channels: int, capacity: int) -> None:
        self._values = np.zeros((channels, capacity), dtype=np.float64)
        self._indices = np.full(capacity, -1, dtype=np.int64)
        self._capacity = capacity

    def write(self, first_sample: int, values: NDArray[np.floating]) -> None:
        """Keep the samples of a block, shape (channels, n)."""
        first_sample += max(0, values.shape[1] - self._capacity)
        values = values[:, -self._capacity :]
        indices = first_sample + np.arange(values.shape[1])
        slots = indices % self._capacity
        self._values[:, slots] = values
        self._indices[slots] = indices

    def read(self, first_sample: int, count: int) -> NDArray[np.float64] | None:
        """Return samples in a row, shape (channels, count); None unless all of them are there."""
        indices = first_sample + np.arange(count)
        slots = indices % self._capacity
        if first_sample < 0 or count > self._capacity or np.any(self._indices[slots] != indices):
            return None
        values: NDArray[np.float64] = self._values[:, slots]
        return values
