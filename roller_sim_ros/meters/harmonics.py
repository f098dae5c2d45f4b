# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Amplitudes at multiples of the excitation frequency, over a sliding window of whole revolutions.

With a fixed number of samples per revolution of the eccentric the analysis is exact in orders: an
order q whose cycles fit the window (q × revolutions is a whole number) is a bin of the window's
DFT, so no other order leaks into it, whatever the excitation frequency. Order 0.5 needs an even
number of revolutions.

The amplitude of order q is defined as ``C_q = (2 / M) Σ a_n exp(−i q φ_n)`` over the M samples of
the window, φ the phase of the eccentric. Each revolution is projected once; the window's sums are
formed anew, oldest revolution first, so a value depends on nothing but the samples of its window: a
stream and a batch give the same bits.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters import kernels
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

METER_ORDERS = (0.5, 1.0, 2.0)
"""Orders that CMV and RMV need."""


class Harmonics(NamedTuple):
    """Complex amplitudes of the vertical acceleration at some orders of the excitation.

    Attributes
    ----------
    orders : tuple of float
        Multiples of the excitation frequency.
    amplitudes : ndarray of complex128, shape (len(orders),)
        C_q, m/s², in the order of `orders`.
    """

    orders: tuple[float, ...]
    amplitudes: NDArray[np.complex128]

    def amplitude(self, order: float) -> float:
        """Return A_order = |C_order|, in m/s²."""
        value = self.amplitudes.item(self.orders.index(order))
        return math.hypot(value.real, value.imag)

    def phase(self, order: float) -> float:
        """Return θ in (−π, π] so that the component is A sin(q φ + θ), φ the eccentric's phase.

        The vertical force of the eccentric goes with sin φ: a free drum has θ = 0 at order 1, and a
        negative θ is an acceleration that lags the eccentric.
        """
        value = self.amplitudes[self.orders.index(order)]
        return math.atan2(value.real, -value.imag)


class HarmonicsWindow:
    """Sliding window of whole revolutions; `push` one revolution, read `harmonics`.

    Parameters
    ----------
    window_revolutions : int
        Revolutions in the window.
    orders : sequence of float
        Orders of interest; each times `window_revolutions` must be a whole number.
    samples_per_revolution : int
        N, samples in one revolution.

    Raises
    ------
    ValueError
        If an order is no bin of the window or lies at or above the Nyquist order N/2.
    """

    def __init__(
        self,
        window_revolutions: int,
        orders: Sequence[float] = METER_ORDERS,
        samples_per_revolution: int = SAMPLES_PER_REVOLUTION,
    ) -> None:
        if window_revolutions < 1:
            raise ValueError(f"window_revolutions = {window_revolutions}: must be at least 1")
        for order in orders:
            if not (order * window_revolutions).is_integer():
                raise ValueError(
                    f"order {order:g} is no whole number of cycles in {window_revolutions} revolutions"
                )
            if not 0.0 < order < samples_per_revolution / 2:
                raise ValueError(
                    f"order {order:g} must lie above 0 and below {samples_per_revolution / 2:g}"
                )
        self.window_revolutions = window_revolutions
        self.orders = tuple(float(order) for order in orders)
        self.samples_per_revolution = samples_per_revolution
        turns = np.outer(np.arange(samples_per_revolution) / samples_per_revolution, self.orders)
        # Cosines of all orders, then sines, side by side for each sample.
        self._waves = np.concatenate(_unit_vectors(turns), axis=1)
        self._products = np.zeros(2 * len(self.orders))
        self._turns = _unit_vectors(np.outer(np.arange(window_revolutions), self.orders))
        self._scale = 2.0 / (samples_per_revolution * window_revolutions)
        # Every sum is stored twice, a window apart, so that the window is always one contiguous view.
        self._sums = np.zeros((2, len(self.orders), 2 * window_revolutions))
        self._next = 0
        self._held = 0

    def clear(self) -> None:
        """Forget all revolutions."""
        self._next = 0
        self._held = 0

    @property
    def full(self) -> bool:
        """Whether the window holds all its revolutions."""
        return self._held == self.window_revolutions

    def push(self, revolution: NDArray[np.float64], index: int = 0, phase_rad: float = 0.0) -> None:
        """Add the newest revolution and drop the oldest of a full window.

        Parameters
        ----------
        revolution : ndarray, shape (samples_per_revolution,)
            Vertical acceleration, m/s².
        index : int
            Number of the revolution; consecutive in a window (half orders turn by π from one to the
            next).
        phase_rad : float
            Phase of the eccentric at the first sample.
        """
        turns, row = self._turns, index % self.window_revolutions
        if phase_rad != 0.0:
            turns, row = self._turned(row, phase_rad), 0
        slot = self._next
        kernels.keep(
            self._waves,
            np.ascontiguousarray(revolution),
            self._products,
            turns,
            row,
            self._sums,
            slot,
        )
        self._next = (slot + 1) % self.window_revolutions
        if self._held < self.window_revolutions:
            self._held += 1

    def harmonics(self) -> Harmonics:
        """Return the amplitudes over the window; NaN while it is not full."""
        if not self.full:
            unknown = np.full(len(self.orders), complex(math.nan, math.nan))
            return Harmonics(self.orders, unknown)
        amplitudes = np.empty(len(self.orders), dtype=np.complex128)
        kernels.window_sums(self._sums, self._next, self._scale, amplitudes)
        return Harmonics(self.orders, amplitudes)

    def _turned(self, row: int, phase_rad: float) -> NDArray[np.float64]:
        """Return cos and sin of q (2π row + phase), shape (2, 1, orders)."""
        real, imaginary = self._turns[:, row]
        angle = np.array(self.orders) * phase_rad
        cosine, sine = np.cos(angle), np.sin(angle)
        turned = [real * cosine - imaginary * sine, imaginary * cosine + real * sine]
        return np.array(turned)[:, np.newaxis]


def order_amplitudes(
    vertical: NDArray[np.floating],
    orders: Sequence[float] = METER_ORDERS,
    samples_per_revolution: int = SAMPLES_PER_REVOLUTION,
) -> Harmonics:
    """Return the amplitudes over a whole array, which begins at phase zero.

    Parameters
    ----------
    vertical : ndarray, shape (revolutions × samples_per_revolution,)
        Vertical acceleration, m/s².
    orders : sequence of float
        Orders of interest.
    samples_per_revolution : int
        Samples in one revolution.

    Returns
    -------
    Harmonics
        The same bits as a `HarmonicsWindow` of that length gives.
    """
    revolutions = np.asarray(vertical, dtype=np.float64).reshape(-1, samples_per_revolution)
    window = HarmonicsWindow(len(revolutions), orders, samples_per_revolution)
    for index, revolution in enumerate(revolutions):
        window.push(revolution, index)
    return window.harmonics()


def _unit_vectors(turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return cos and sin of 2π `turns`, stacked in front, exact at multiples of a quarter turn."""
    fraction = turns - np.floor(turns)
    quarters = np.rint(4.0 * fraction)
    rest = 2.0 * math.pi * (fraction - quarters / 4.0)
    cosine, sine = np.cos(rest), np.sin(rest)
    quarter = quarters.astype(np.int64) % 4
    return np.stack(
        [
            np.choose(quarter, [cosine, -sine, -cosine, sine]),
            np.choose(quarter, [sine, cosine, -sine, -cosine]),
        ]
    )
