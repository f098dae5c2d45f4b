# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""k_s: the stiffness of the ground, from the drum's travel and its lag behind the eccentric."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters.drum import DrumMotion


class KS:
    """k_s = ω² (m_d + m_e r_e cos δ / z_1) (Ammann); N/m.

    It is the spring of a drum on spring and dashpot that never parts from them: z_1 is the amplitude of the
    travel at the excitation frequency and δ its lag behind the eccentric; the dashpot is in the sine. In
    terms of the acceleration's fundamental, k_s = ω² (m_d + F Im C_1 / |C_1|²).
    """

    name: ClassVar[str] = "k_s"
    label: ClassVar[str] = "k_s"
    unit: ClassVar[str] = "N/m"
    source: ClassVar[str] = (
        "Ammann, as commonly cited: Anderegg and Kaufmann, Intelligent compaction with vibratory rollers, "
        "TRR 1868 (2004)"
    )
    verified: ClassVar[bool] = False

    def value(self, motion: DrumMotion) -> NDArray[np.float64]:
        """Return k_s of each motion, N/m, shape (...); NaN where the drum does not vibrate."""
        fundamental = motion.fundamental
        squared = np.abs(fundamental) ** 2
        with np.errstate(invalid="ignore", divide="ignore"):
            inertia = motion.force_amplitude * fundamental.imag / squared
        stiffness = motion.omega**2 * (motion.drum.mass_kg + inertia)
        return np.where(squared > 0.0, stiffness, np.nan)
