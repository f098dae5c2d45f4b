"""Whether the drum leaves the ground, from its vertical acceleration alone.

A meter knows neither masses nor amplitude, but it knows what a flight looks like. In the air
``a = A ω² sin φ + c`` with c = −F_stat / m_d, and since the frame rests on the drum, c ≤ −g
whatever the machine. The combination of three samples, h apart,

    c_n = [a(n+h) + a(n−h) − 2 cos(h δ) a(n)] / [2 (1 − cos h δ)],   δ = 2π / N,

cancels everything at the excitation frequency and leaves exactly c in the air. So, for a waveform
of zero mean (a drum that goes nowhere has none, and a meter cannot know it better):

- nowhere c_n ≤ −g: no flight of 2h + 1 samples or more, the drum keeps contact;
- c_n level within 1 % over 9 samples, at or below −g: a flight;
- else it cannot be told: a flight shorter than 2h + 9 samples (13 % of a revolution), strong
  distortion in contact, or a sensor too noisy for the test.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.parameters import GRAVITY_M_S2

STEP_SHARE = 1 / 32
"""h as a share of the revolution."""

LEVEL_SHARE = 9 / 128
"""Length over which a flight has to be level, as a share of the revolution."""

LEVEL_TOLERANCE = 0.01
"""Range of c over that length, as a share of c."""

GRAVITY_MARGIN = 0.95
"""A flight falls with at least this share of g: the rest is for the meter's scale and mean."""


def lifts(waveform: NDArray[np.float64]) -> bool | None:
    """Return whether one revolution of a motion of period 1 shows a flight, None if it does not tell.

    Parameters
    ----------
    waveform : ndarray, shape (samples_per_revolution,)
        Vertical acceleration of one revolution, taken as periodic, without its mean, m/s².
    """
    samples = len(waveform)
    step = max(1, round(STEP_SHARE * samples))
    level = max(3, round(LEVEL_SHARE * samples))
    cosine = math.cos(2.0 * math.pi * step / samples)
    around = np.concatenate([waveform[-step:], waveform, waveform[:step]])
    fall = (around[2 * step :] + around[: -2 * step] - 2.0 * cosine * waveform) / (
        2.0 * (1.0 - cosine)
    )
    bound = -GRAVITY_MARGIN * GRAVITY_M_S2
    if not fall.min() <= bound:
        return False
    around = np.concatenate([fall, fall[: level - 1]])
    stretches = np.lib.stride_tricks.sliding_window_view(around, level)
    highest = stretches.max(axis=1)
    lowest = stretches.min(axis=1)
    flights = (highest <= bound) & (highest - lowest <= -LEVEL_TOLERANCE * highest)
    return True if bool(flights.any()) else None
