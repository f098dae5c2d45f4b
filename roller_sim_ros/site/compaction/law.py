# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What all compaction laws have in common: how much a pass counts, and where compaction ends."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.parameters import Soil
from roller_sim_ros.site.declaration import Record, declare, like
from roller_sim_ros.site.ground_values import GroundValues
from roller_sim_ros.site.profile import Profile

Array = NDArray[np.float64]

ASSUMED = "assumed by this project"


@dataclass(frozen=True)
class CompactionLaw(Record):
    """Stiffness grows and p falls towards limits with the passes that a cell has had.

    A cell remembers one number, the passes n that it has had, counted in passes of the reference: vibrating with
    at least the static load, at the reference speed. G = G_0 + c (G_lim − G_0) (1 − r(n)), p alike, with the law's
    r(0) = 1 falling to 0 and c the cell's compactability. Ground that is stiffer than the limit stays as it is.
    """

    limit_shear_modulus_mpa: float | None = like(
        "soil.shear_modulus_pa", "shear modulus that no number of passes exceeds; left out: G stays"
    )
    limit_plastic_mm: float | None = like(
        "soil.plastic_parameter_m",
        "plastic parameter that no number of passes falls below; left out: it goes with the limit of G as in the "
        "ground's plastic_mm",
    )
    reference_speed_m_s: float = declare(
        "speed at which one pass counts as one",
        default=1.0,
        minimum=0.05,
        maximum=5.0,
        source="usual rolling speeds are 3 to 6 km/h (Forssblad 1981, as commonly cited)",
    )
    speed_exponent: float = declare(
        "a pass counts (reference speed / speed)^this: 1, as the number of blows per metre; 0, not at all",
        default=1.0,
        minimum=0.0,
        maximum=1.0,
        source=f"{ASSUMED}: the same number of blows per metre compacts alike",
    )
    static_share: float = declare(
        "what a pass without vibration counts; up to an exciter force equal to the static load it rises linearly to 1",
        default=0.2,
        minimum=0.0,
        maximum=1.0,
        source=ASSUMED,
    )

    @abstractmethod
    def remaining(self, passes: Array) -> Array:
        """Return r(n), the share of the way to the limits that is still to go, 1 at n = 0."""

    def effort(self, speed_m_s: float, force_ratio: float) -> float:
        """Return how many passes a second on the ground counts, per metre of ground, 1/(s/m).

        Parameters
        ----------
        speed_m_s : float
            Travel speed, not negative.
        force_ratio : float
            Exciter force over static load.
        """
        vibrating = self.static_share + (1.0 - self.static_share) * min(1.0, force_ratio)
        travelled = speed_m_s ** (1.0 - self.speed_exponent)
        return float(vibrating * travelled * self.reference_speed_m_s**self.speed_exponent)

    def limits(self, profile: Profile) -> tuple[Array, Array]:
        """Return G and p that each cell approaches, none worse than what it has.

        Raises
        ------
        ParameterError
            If the limits are beyond the model's bounds under this machine.
        """
        stiff, firm = profile.shear_modulus_pa, profile.plastic_parameter_m
        soil = GroundValues(
            shear_modulus_mpa=self.limit_shear_modulus_mpa, plastic_mm=self.limit_plastic_mm
        )
        share = profile.compactability
        if self.limit_shear_modulus_mpa is not None:
            limit = soil.soil(profile.machine, Soil())
            stiff = stiff + share * np.maximum(limit.shear_modulus_pa - stiff, 0.0)
            firm = firm - share * np.maximum(firm - limit.plastic_parameter_m, 0.0)
        elif self.limit_plastic_mm is not None:
            firm = firm - share * np.maximum(firm - self.limit_plastic_mm / 1e3, 0.0)
        return stiff, firm
