# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The analogue low-pass before sampling."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.sensors.kernels import recurse_two
from roller_sim_ros.sensors.second_order import Step, signal_step
from roller_sim_ros.sensors.stage import Signals

Array = NDArray[np.float64]


class LowPass:
    """Second-order Butterworth of both axes, exact for a straight line from sample to sample; settled at the start.

    Parameters
    ----------
    bandwidth_hz : float
        −3 dB frequency.
    """

    def __init__(self, bandwidth_hz: float) -> None:
        self._bandwidth_hz = bandwidth_hz
        self._states: list[Array] = []
        self._last = np.zeros(2)
        self._into_s = 0.0

    def apply(self, signals: Signals) -> Signals:
        """Return the signals as they come through."""
        axes = (signals.vertical, signals.horizontal)
        if not len(signals.vertical):
            return signals
        step = signal_step(self._bandwidth_hz, signals.period_s)
        if not self._states:
            self._states = [np.array([axis[0], 0.0]) for axis in axes]
            self._last[:] = [axis[0] for axis in axes]
            self._into_s = signals.period_s
        # The first sample lies one period of the piece before it after that piece's last.
        into = signal_step(self._bandwidth_hz, self._into_s)
        out = []
        for index, (axis, state) in enumerate(zip(axes, self._states, strict=True)):
            before = np.concatenate((self._last[index : index + 1], axis[:-1]))
            result = np.empty_like(axis)
            _step(into, axis[:1], before[:1], state, result[:1])
            _step(step, axis[1:], before[1:], state, result[1:])
            self._last[index] = axis[-1]
            out.append(result)
        self._into_s = signals.period_s
        return Signals(out[0], out[1], signals.period_s)


def _step(step: Step, axis: Array, before: Array, state: Array, out: Array) -> None:
    rise = axis - before
    inputs = np.stack([step.hold[i] * before + step.slope[i] * rise for i in (0, 1)])
    recurse_two(step.matrix, inputs, state, out)
