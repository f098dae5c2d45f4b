# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Model-based controller: estimates G and p, and asks its own model of the roller for the setting that fits them.

Frequency: the resonance of the drum on that ground. Amplitude: a little less than the largest with which the drum of
the model does not double-jump there. Speed: so that the blows are evenly spaced. The aim is Sandström's (US patent
5727900, expired); the rules are this example's.

    python -m examples.controllers.model_based --ros-args -p margin:=0.85
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from examples.controllers.measurement import REVOLUTIONS, Command, Measurement
from roller_sim_ros.estimate import estimate_window
from roller_sim_ros.half_space.static import static_compliance
from roller_sim_ros.meters.harmonics import order_amplitudes
from roller_sim_ros.meters.registry import ORDERS, evaluate
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.session import Session
from roller_sim_ros.soil_mechanics import machine_preset

TRIED_REVOLUTIONS, HALVINGS = 96, 5
"""How long the model runs with an amplitude, and how often the range of amplitudes is halved."""


@dataclass
class ModelBased:
    """Estimates and decides anew every some revolutions, from samples at a steady setting.

    Parameters
    ----------
    every_revolutions : int
        From decision to decision; enough for the exciter's ramp and a window of 16 revolutions after it.
    margin : float
        Share of the largest amplitude without double jump.
    least_m : float
        Smallest amplitude, m; the largest is what was commanded at the start.
    least_hz, most_hz : float
        Range of the frequency, Hz.
    blows_per_m : float
        Revolutions per metre of travel.
    direction : int
        1 or −1: towards growing or falling chainage.
    machine : str
        Name of the roller's preset.
    """

    every_revolutions: int = 40
    margin: float = 0.9
    least_m: float = 0.4e-3
    least_hz: float = 24.0
    most_hz: float = 32.0
    blows_per_m: float = 28.0
    direction: int = 1
    machine: str = "paper-10t"
    _command: Command | None = field(default=None, init=False)
    _most_m: float = field(default=0.0, init=False)

    def __post_init__(self) -> None:
        self.known = Configuration().changed(machine_preset(self.machine).values())

    def update(self, measurement: Measurement) -> Command:
        """Answer a measurement: as before, unless a decision is due and the ground can be told."""
        if self._command is None:
            self._most_m = measurement.commanded_amplitude_m
            self._command = self._at_speed(
                measurement.commanded_frequency_hz, measurement.commanded_amplitude_m
            )
        due = (measurement.revolution + 1) % self.every_revolutions == 0
        if due and len(measurement.vertical) == REVOLUTIONS:
            known = self._with(measurement.frequency_hz, measurement.amplitude_m)
            found = estimate_window(measurement.vertical, known)
            if found.status.stands:
                soil = replace(
                    known.soil,
                    shear_modulus_pa=found.shear_modulus_pa,
                    plastic_parameter_m=found.plastic_parameter_m,
                )
                self.known = replace(known, soil=soil)
                self._command = self.decide()
        return self._command

    def decide(self) -> Command:
        """Return the setting for the ground in `known`."""
        frequency_hz = min(self.most_hz, max(self.least_hz, self.resonance_hz()))
        low_m, high_m = self.least_m, self._most_m
        if self.jumps(frequency_hz, high_m):
            for _ in range(HALVINGS):
                middle_m = 0.5 * (low_m + high_m)
                if self.jumps(frequency_hz, middle_m):
                    high_m = middle_m
                else:
                    low_m = middle_m
            high_m = self.margin * low_m
        return self._at_speed(frequency_hz, high_m)

    def resonance_hz(self) -> float:
        """Return the natural frequency of the drum on the static stiffness of the half space, Hz."""
        machine, soil = self.known.machine, self.known.soil
        half_width_m = self.known.half_space.area_factor * math.sqrt(
            2.0 * machine.drum_radius_m * soil.plastic_parameter_m
        )
        compliance = static_compliance(
            soil.shear_modulus_pa, soil.poisson_ratio, half_width_m, 0.5 * machine.drum_width_m
        )
        return 1.0 / (2.0 * math.pi * math.sqrt(machine.drum_mass_kg * compliance))

    def jumps(self, frequency_hz: float, amplitude_m: float) -> bool:
        """Return whether the model's drum double-jumps on the ground in `known`."""
        session = Session(self._with(frequency_hz, amplitude_m))
        blocks = [session.advance(128) for _ in range(TRIED_REVOLUTIONS)]
        vertical = np.concatenate([block.acceleration_vertical for block in blocks[-REVOLUTIONS:]])
        return evaluate(order_amplitudes(vertical, ORDERS))["rmv"] > 1.0

    def _with(self, frequency_hz: float, amplitude_m: float) -> Configuration:
        exciter = replace(self.known.exciter, frequency_hz=frequency_hz, amplitude_m=amplitude_m)
        return replace(self.known, exciter=exciter)

    def _at_speed(self, frequency_hz: float, amplitude_m: float) -> Command:
        return Command(frequency_hz, amplitude_m, self.direction * frequency_hz / self.blows_per_m)


if __name__ == "__main__":
    from examples.controllers.node import spin

    spin("model_based", ModelBased)
