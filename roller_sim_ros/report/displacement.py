# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Displacements of a drum to be drawn: from its acceleration, and less what it sinks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION


def without_sinking(height: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """Return the height of whole revolutions without its steady fall, and that fall a revolution, m."""
    means = height.reshape(-1, SAMPLES_PER_REVOLUTION).mean(axis=1)
    half = len(means) // 2
    # From half to half, each of an even number of revolutions: a drum that double-jumps does not sink by that.
    sinking_m = float(means[:half].mean() - means[half:].mean()) / half
    return height + sinking_m * np.arange(len(height)) / SAMPLES_PER_REVOLUTION, sinking_m


def twice_integrated(acceleration: NDArray[np.float64], rate_hz: float) -> NDArray[np.float64]:
    """Return the periodic displacement without mean whose second derivative is an acceleration of whole periods."""
    spectrum = np.fft.rfft(acceleration)
    turn = 2.0 * np.pi * np.fft.rfftfreq(len(acceleration), 1.0 / rate_hz)
    spectrum[0] = 0.0
    spectrum[1:] /= -(turn[1:] ** 2)
    return np.fft.irfft(spectrum, len(acceleration))
