# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Grounds by name, each with where its numbers are from."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Protocol

from roller_sim_ros.parameters import Machine, Soil
from roller_sim_ros.soil_mechanics.granular_soil import GranularSoil
from roller_sim_ros.soil_mechanics.plastic_parameter import scaled_plastic_parameter
from roller_sim_ros.soil_mechanics.presets import find


class Ground(Protocol):
    """What is known of a ground; the model's soil under a machine follows from it."""

    def soil(self, machine: Machine) -> Soil:
        """Return the model's soil under a machine."""
        ...


@dataclass(frozen=True)
class FittedSoil:
    """G and p as found with one machine; under another p is scaled.

    Attributes
    ----------
    fitted : Soil
        Under `measured_with`.
    measured_with : Machine
        The machine.
    """

    fitted: Soil
    measured_with: Machine

    def soil(self, machine: Machine) -> Soil:
        """Return the model's soil under a machine."""
        plastic = scaled_plastic_parameter(
            self.fitted.plastic_parameter_m, self.measured_with, machine
        )
        return replace(self.fitted, plastic_parameter_m=plastic)


@dataclass(frozen=True)
class SoilPreset:
    """A ground with a name.

    Attributes
    ----------
    name, doc : str
        As on the command line, and a line on it.
    ground : Ground
        Its numbers.
    source : str
        Where they are from.
    verified : bool
        Whether all of them were read there.
    """

    name: str
    doc: str
    ground: Ground
    source: str
    verified: bool

    def soil(self, machine: Machine) -> Soil:
        """Return the model's soil under a machine."""
        return self.ground.soil(machine)


# Relative density I_D gives all of a state: e = e_max − I_D (e_max − e_min); γ from e, grains of 2650 kg/m³ and 5 %
# of water; φ = φ_cv + 5° I_R in plane strain, I_R = I_D (10 − ln 150) − 1 at a mean stress of 150 kPa (Bolton).
_DILATANCY = (
    "φ in plane strain from Bolton, The strength and dilatancy of sands, Géotechnique 36 (1986), at 150 kPa with "
    "φ_cv {cv}° and relative density {density}; e from {loosest} to {densest}; K_0 and a depth of 1 m "
    "assumed; G by Hardin and Richart, p by Vesić's N_γ"
)


def _granular(
    name: str, doc: str, cv: int, density: float, loosest: float, densest: float, k0: float
) -> SoilPreset:
    void_ratio = loosest - density * (loosest - densest)
    unit_weight = 2650.0 * 1.05 * 9.81 / (1.0 + void_ratio)
    friction_angle = cv + 5.0 * (density * (10.0 - math.log(150.0)) - 1.0)
    state = GranularSoil(
        void_ratio=round(void_ratio, 3),
        friction_angle_rad=math.radians(round(friction_angle, 1)),
        unit_weight_n_m3=round(unit_weight, -1),
        earth_pressure_coefficient=k0,
    )
    source = _DILATANCY.format(cv=cv, density=density, loosest=loosest, densest=densest)
    return SoilPreset(name, doc, state, source, verified=False)


def _paper(name: str, doc: str, shear_modulus_pa: float, plastic_m: float) -> SoilPreset:
    fitted = Soil(shear_modulus_pa=shear_modulus_pa, plastic_parameter_m=plastic_m)
    source = (
        "Sandström, Numerical simulation of a vibratory roller on cohesionless soil (1994), Figure 15; p holds "
        "for the paper's machine and is scaled to others"
    )
    return SoilPreset(name, doc, FittedSoil(fitted, Machine()), source, verified=True)


SOILS: dict[str, SoilPreset] = {
    preset.name: preset
    for preset in (
        _granular("loose-gravel", "gravel as tipped", 35, 0.3, 0.75, 0.25, 0.4),
        _granular("medium-gravel", "gravel after some passes", 35, 0.6, 0.75, 0.25, 0.6),
        _granular("dense-gravel", "well compacted gravel", 35, 0.8, 0.75, 0.25, 0.8),
        _granular("sand", "medium dense quartz sand", 33, 0.5, 0.85, 0.45, 0.45),
        _paper("paper-soft", "the paper's softer ground: period 1", 35e6, 0.8e-3),
        _paper("paper-stiff", "the paper's stiffer ground: double jump", 80e6, 0.5e-3),
    )
}
"""All grounds; a new one is one line."""


def soil_preset(name: str) -> SoilPreset:
    """Return a preset by its name.

    Raises
    ------
    ParameterError
        If there is none; the message lists those that there are.
    """
    return find("soil", name, SOILS)
