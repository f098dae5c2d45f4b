# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The sensor's noise: white at its element, shaped by its bandwidth, then sampled."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from roller_sim_ros.sensors.kernels import recurse_two
from roller_sim_ros.sensors.second_order import noise_step, variance
from roller_sim_ros.sensors.stage import Signals

Array = NDArray[np.float64]


class Noise:
    """Adds noise of a one-sided density to both axes, stationary from the start.

    Through a low-pass of second order it is that process, exact at the samples, with what sampling folds back, so
    that its variance is density² · 1.11 · bandwidth whatever the sample rate. Without a bandwidth it is white up to
    half the sample rate.

    Parameters
    ----------
    density : float
        One-sided amplitude density, m/s²/√Hz.
    bandwidth_hz : float
        −3 dB frequency of the low-pass; 0: none.
    stream : callable
        Random numbers of a purpose.
    """

    def __init__(
        self, density: float, bandwidth_hz: float, stream: Callable[[str], Generator]
    ) -> None:
        self._density = density
        self._bandwidth_hz = bandwidth_hz
        self._random = tuple(stream(f"{axis}/noise") for axis in ("vertical", "horizontal"))
        self._states = tuple(
            math.sqrt(variance(bandwidth_hz)) * random.standard_normal(2) for random in self._random
        )
        self._into_s = 0.0

    def apply(self, signals: Signals) -> Signals:
        """Return the signals with noise."""
        count, period_s = len(signals.vertical), signals.period_s
        axes = [
            axis + self._density * self._advance(index, count, period_s)
            for index, axis in enumerate((signals.vertical, signals.horizontal))
        ]
        if count:
            self._into_s = period_s
        return Signals(axes[0], axes[1], period_s)

    def _advance(self, axis: int, count: int, period_s: float) -> Array:
        """Return the next numbers of one axis, of density 1."""
        random = self._random[axis]
        if not self._bandwidth_hz:
            white: Array = math.sqrt(0.5 / period_s) * random.standard_normal(count)
            return white
        normal = random.standard_normal((count, 2))
        out = np.empty(count)
        # The first sample lies one period of the piece before it after that piece's last.
        self._step(axis, self._into_s or period_s, normal[:1], out[:1])
        self._step(axis, period_s, normal[1:], out[1:])
        return out

    def _step(self, axis: int, period_s: float, normal: Array, out: Array) -> None:
        matrix, factor = noise_step(self._bandwidth_hz, period_s)
        inputs = np.stack(
            [
                factor[0, 0] * normal[:, 0] + factor[0, 1] * normal[:, 1],
                factor[1, 0] * normal[:, 0] + factor[1, 1] * normal[:, 1],
            ]
        )
        recurse_two(matrix, inputs, self._states[axis], out)
