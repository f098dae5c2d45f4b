# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Omega: the energy that the drum passes to the soil."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters.drum import DrumMotion


class Omega:
    """Ω = −∮ F_s dz over two revolutions (BOMAG), the mean over the window; J.

    In a motion that repeats, kinetic energy and weight give back what they took, and what the soil gets is the
    work of the exciter. Its force has the fundamental alone, so of all orders of the loop only the first counts:

        Ω = 2π F z_1 sin δ = 2π F Re C_1 / ω²,

    z_1 the amplitude of the travel at the excitation frequency, δ the lag of the drum behind the eccentric. It is
    the area of the loop of `DrumMotion.soil_force` over `DrumMotion.height`, integrated order by order; the work
    of the weight of a drum that sinks, 2 F_stat times the depth per revolution, is not in it.
    """

    name: ClassVar[str] = "omega"
    label: ClassVar[str] = "Omega"
    unit: ClassVar[str] = "J"
    source: ClassVar[str] = "BOMAG, as commonly cited (Kröber, Floss and Wallrath, 2001)"
    verified: ClassVar[bool] = False

    def value(self, motion: DrumMotion) -> NDArray[np.float64]:
        """Return Ω of each motion, J, shape (...)."""
        work = 2.0 * math.pi * motion.force_amplitude * motion.fundamental.real
        return np.asarray(work / motion.omega**2)
