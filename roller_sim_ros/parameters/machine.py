# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The roller: the masses, the drum and what its exciter can do (paper, 'Roller data')."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.parameters.quantity import ParameterGroup, parameter

GRAVITY_M_S2 = 9.81


@dataclass(frozen=True)
class Machine(ParameterGroup):
    """Masses and drum of the roller; the defaults are the paper's 10 t machine."""

    group: ClassVar[str] = "machine"

    frame_mass_kg: float = parameter(
        2400.0,
        "kg",
        "mass of the frame that rests on the drum (m_f), a static load only",
        minimum=0.0,
        maximum=50000.0,
        flag="--frame-mass-kg",
        flag_unit="kg",
    )
    drum_mass_kg: float = parameter(
        3200.0,
        "kg",
        "mass of the vibrating drum (m_d)",
        minimum=50.0,
        maximum=50000.0,
        flag="--drum-mass-kg",
        flag_unit="kg",
    )
    drum_radius_m: float = parameter(
        0.75,
        "m",
        "radius of the drum (r)",
        minimum=0.1,
        maximum=2.0,
        flag="--drum-radius-m",
        flag_unit="m",
    )
    drum_width_m: float = parameter(
        2.1,
        "m",
        "width of the drum across the lane (W)",
        minimum=0.2,
        maximum=5.0,
        flag="--drum-width-m",
        flag_unit="m",
    )
    eccentric_mass_kg: float = parameter(
        50.0,
        "kg",
        "mass of the eccentric, part of the drum mass; with the amplitude it gives the eccentric radius "
        "r_e = A m_d / m_e",
        minimum=1.0,
        maximum=5000.0,
    )

    @property
    def static_load_n(self) -> float:
        """F_stat = (m_f + m_d) g, in N."""
        return (self.frame_mass_kg + self.drum_mass_kg) * GRAVITY_M_S2
