# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Whether the drum leaves the ground, from its vertical acceleration alone.

A meter knows neither masses nor amplitude, but it knows what a flight looks like. In the air
``a = A ω² sin φ + c`` with c = −F_stat / m_d, and since the frame rests on the drum, c ≤ −g whatever the
machine. The combination of three samples, h apart,

    c_n = [a(n+h) + a(n−h) − 2 cos(h δ) a(n)] / [2 (1 − cos h δ)],   δ = 2π / N,

cancels everything at the excitation frequency and leaves exactly c in the air. In contact it varies with
the soil's force. So, for an acceleration less its mean (a drum that goes nowhere has none, and a meter
cannot know it better):

- c_n level over some samples, at or below −g: a flight;
- c_n above −g everywhere: no flight of 2h + 1 samples;
- no level stretch of a few samples although the noise would allow to see it: no flight longer than that;
- else it cannot be told.

Two sets of h, length and tolerance are tried. The fine one sees flights of 8 samples of 128 (6 % of a
revolution) and needs samples that are exact to about 1e-5 of their size; the coarse one needs 17 samples
(13 %) and stands some noise. Noise is what differs between two repetitions of the motion, after the same
combination of samples; a slow drift passes it. What is shorter than the fine one sees is taken for contact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters import kernels
from roller_sim_ros.parameters import GRAVITY_M_S2

GRAVITY_SHARE = 0.95
"""A flight falls with at least this share of g: the rest is for the sensor's scale and the mean."""


@dataclass(frozen=True)
class FlightTest:
    """How a flight is looked for.

    Attributes
    ----------
    step : float
        h as a share of the revolution.
    length : float
        Length over which c has to be level, as a share of the revolution.
    tolerance : float
        Its range over that length, as a share of c.
    """

    step: float
    length: float
    tolerance: float


FINE = FlightTest(step=2 / 128, length=4 / 128, tolerance=1e-3)
COARSE = FlightTest(step=4 / 128, length=9 / 128, tolerance=1e-2)


def lifts(repetitions: NDArray[np.float64], samples_per_revolution: int) -> bool | None:
    """Return whether a motion has a flight, None if it cannot be told.

    Parameters
    ----------
    repetitions : ndarray, shape (repetitions, period × samples_per_revolution)
        Vertical acceleration, m/s², at least two repetitions of the motion, oldest first.
    samples_per_revolution : int
        N.
    """
    found = kernels.lifting(
        np.ascontiguousarray(repetitions, dtype=np.float64),
        _in_samples(COARSE, samples_per_revolution),
        _in_samples(FINE, samples_per_revolution),
        -GRAVITY_SHARE * GRAVITY_M_S2,
        FINE.tolerance * GRAVITY_M_S2,
        np.empty((2, repetitions.shape[1])),
    )
    return None if found == kernels.CANNOT_TELL else found == kernels.LIFTS


@cache
def _in_samples(test: FlightTest, samples_per_revolution: int) -> tuple[int, float, int, float]:
    """Return h and the cosine of its angle, length and tolerance as the kernel takes them."""
    step = max(1, round(test.step * samples_per_revolution))
    length = max(3, round(test.length * samples_per_revolution))
    angle = 2.0 * math.pi * step / samples_per_revolution
    return step, math.cos(angle), length, test.tolerance
