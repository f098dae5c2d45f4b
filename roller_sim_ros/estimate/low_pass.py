# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The sensor's analogue low-pass, order by order: it delays the blow, which else looks like another ground."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.estimate.status import EstimateError

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

MOST_UNDONE = 3.0
"""By what an order is raised at most when the low-pass is undone: beyond that it is noise."""


def low_pass(
    count: int, period: int, excitation_hz: float, bandwidth_hz: float
) -> ComplexArray | None:
    """Return the response of a second-order Butterworth low-pass at the orders of a waveform.

    Parameters
    ----------
    count : int
        Samples of the waveform.
    period : int
        Revolutions in it.
    excitation_hz : float
        Of the eccentric.
    bandwidth_hz : float
        Frequency of −3 dB; 0: no low-pass.

    Returns
    -------
    ndarray, shape (count/2 + 1,), or None
        None without a low-pass.

    Raises
    ------
    EstimateError
        If the bandwidth is negative or no number.
    """
    if not bandwidth_hz >= 0.0:
        raise EstimateError(f"sensor_bandwidth_hz = {bandwidth_hz} must be at least 0")
    if bandwidth_hz == 0.0:
        return None
    s = 1j * np.arange(count // 2 + 1) * excitation_hz / (period * bandwidth_hz)
    return np.asarray(1.0 / (1.0 + np.sqrt(2.0) * s + s * s))


def passed(vertical: Array, response: ComplexArray | None) -> Array:
    """Return a periodic waveform behind the low-pass."""
    if response is None:
        return vertical
    return np.fft.irfft(np.fft.rfft(vertical) * response, len(vertical))


def undone(vertical: Array, response: ComplexArray | None) -> Array:
    """Return a periodic waveform as it was before the low-pass, as far as its noise allows."""
    if response is None:
        return vertical
    least = np.maximum(1.0, 1.0 / (MOST_UNDONE * np.abs(response)))
    return np.fft.irfft(np.fft.rfft(vertical) / (response * least), len(vertical))
