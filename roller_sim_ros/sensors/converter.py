# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The end of the range and the converter: what does not fit stays at the end, and nothing wraps around."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Converted(NamedTuple):
    """One axis as it is delivered.

    Attributes
    ----------
    values : ndarray of float32, shape (n,)
        m/s².
    counts : ndarray of int32, shape (n,) or (0,)
        Of the converter.
    clipped : ndarray of bool, shape (n,)
        Whether the signal lay beyond the range.
    """

    values: NDArray[np.float32]
    counts: NDArray[np.int32]
    clipped: NDArray[np.bool_]


class Converter:
    """Clips at ±range, then rounds to counts of range/2^(bits−1).

    A signal that is no number (a lost connection) stays none and has the most negative count, which no other
    signal has.

    Parameters
    ----------
    range_m_s2 : float
        Range; 0: none.
    bits : int
        Bits; 0: no converter.

    Attributes
    ----------
    scale : float
        m/s² per count; 0 without a converter.
    """

    def __init__(self, range_m_s2: float, bits: int) -> None:
        self._range = range_m_s2
        self._most = 2 ** (bits - 1) - 1 if bits else 0
        self.scale = range_m_s2 / 2.0 ** (bits - 1) if bits else 0.0

    def convert(self, signal: Array) -> Converted:
        """Return what is delivered of one axis."""
        clipped = np.abs(signal) > self._range if self._range else np.zeros(len(signal), np.bool_)
        if self._range:
            signal = np.clip(signal, -self._range, self._range)
        if not self.scale:
            return Converted(signal.astype(np.float32), np.zeros(0, np.int32), clipped)
        counts = np.clip(np.rint(signal / self.scale), -self._most, self._most)
        values = (counts * self.scale).astype(np.float32)
        lost = np.isnan(counts)
        raw = np.where(lost, -self._most - 1, counts).astype(np.int32)
        return Converted(values, raw, clipped)
