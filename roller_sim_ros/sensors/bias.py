# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Sensitivity error, constant bias and its drift."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from roller_sim_ros.sensors.kernels import recurse_one
from roller_sim_ros.sensors.sheet import AccelerometerSheet
from roller_sim_ros.sensors.stage import Signals

Array = NDArray[np.float64]


class GaussMarkov:
    """First-order Gauss-Markov process in exact discretisation, stationary from the start.

    b ← e^(−T/τ) b + σ √(1 − e^(−2T/τ)) w, w standard normal (Maybeck, Stochastic Models 1, 4.11).

    Parameters
    ----------
    deviation : float
        σ, standard deviation.
    time_s : float
        τ, correlation time.
    random : Generator
        Its numbers.
    """

    def __init__(self, deviation: float, time_s: float, random: Generator) -> None:
        self._deviation = deviation
        self._time_s = time_s
        self._random = random
        self._state = deviation * random.standard_normal(1)

    def advance(self, count: int, period_s: float) -> Array:
        """Return the values of the next `count` steps of a period, s."""
        factor = math.exp(-period_s / self._time_s)
        gain = self._deviation * math.sqrt(-math.expm1(-2.0 * period_s / self._time_s))
        out = np.empty(count)
        recurse_one(factor, gain * self._random.standard_normal(count), self._state, out)
        return out


class Bias:
    """Scales both axes and adds bias and drift.

    Parameters
    ----------
    sheet : AccelerometerSheet
        The data sheet.
    stream : callable
        Random numbers of a purpose.
    """

    def __init__(self, sheet: AccelerometerSheet, stream: Callable[[str], Generator]) -> None:
        self._gain = 1.0 + sheet.sensitivity_error
        self._bias = (sheet.bias_vertical_m_s2, sheet.bias_horizontal_m_s2)
        self._drift: tuple[GaussMarkov, ...] = ()
        if sheet.drift_m_s2:
            self._drift = tuple(
                GaussMarkov(sheet.drift_m_s2, sheet.drift_time_s, stream(f"{axis}/drift"))
                for axis in ("vertical", "horizontal")
            )

    def apply(self, signals: Signals) -> Signals:
        """Return the signals with the errors."""
        axes = [
            self._gain * axis + bias
            for axis, bias in zip((signals.vertical, signals.horizontal), self._bias, strict=True)
        ]
        if self._drift:
            axes = [
                axis + drift.advance(len(axis), signals.period_s)
                for axis, drift in zip(axes, self._drift, strict=True)
            ]
        return Signals(axes[0], axes[1], signals.period_s)
