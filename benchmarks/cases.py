# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The paper's two roller/soil pairs of Figure 15, at 28 Hz and 1.6 mm."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import GROUNDS
from roller_sim_ros.exciter import ExciterDrive
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration

FREQUENCY_HZ = 28.0
AMPLITUDE_M = 1.6e-3
SETTLING_REVOLUTIONS = 400


@dataclass(frozen=True)
class Case:
    """A soil: G and p, SI."""

    shear_modulus_pa: float
    plastic_parameter_m: float

    @property
    def name(self) -> str:
        """As the paper writes it."""
        return f"G {self.shear_modulus_pa / 1e6:g} p {self.plastic_parameter_m * 1e3:g}"

    def configuration(self, model: str) -> Configuration:
        """Return the roller on this soil with a half space."""
        default = Configuration()
        return replace(
            default,
            soil=replace(
                default.soil,
                shear_modulus_pa=self.shear_modulus_pa,
                plastic_parameter_m=self.plastic_parameter_m,
            ),
            half_space=replace(default.half_space, model=model),
            exciter=replace(
                default.exciter, vibrate=True, frequency_hz=FREQUENCY_HZ, amplitude_m=AMPLITUDE_M
            ),
        )


CASES = (Case(35e6, 0.8e-3), Case(80e6, 0.5e-3))


class GroundRun:
    """Drum and soil of a case, revolution by revolution from static equilibrium."""

    def __init__(self, model: str, case: Case) -> None:
        configuration = case.configuration(model)
        self._soil = configuration.soil
        self._drive = ExciterDrive(
            configuration.exciter, configuration.sampling.floor_hz, run_up=False
        )
        self.ground = GROUNDS[model](
            configuration.machine,
            configuration.soil,
            configuration.half_space,
            configuration.exciter,
            SAMPLES_PER_REVOLUTION,
        )

    def begin(self) -> None:
        """Begin the next revolution."""
        self.ground.begin(self._drive.next_revolution(), self._soil)

    def advance(self, revolutions: int) -> NDArray[np.float64]:
        """Return the samples of the next revolutions, rows as in `roller_sim_ros.drum_soil.state`."""
        found = []
        for _ in range(revolutions):
            self.begin()
            found.append(self.ground.advance(0, SAMPLES_PER_REVOLUTION))
        return np.concatenate(found, axis=1)
