# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""G, p, ρ and ν of a stretch of ground as a scenario file gives them: by name, or by value."""

from __future__ import annotations

from dataclasses import dataclass, replace

from roller_sim_ros.parameters import Machine, Soil, covarying_plastic_parameter
from roller_sim_ros.site.declaration import Record, declare, like
from roller_sim_ros.soil_mechanics import SOILS, scaled_plastic_parameter, soil_preset


@dataclass(frozen=True)
class GroundValues(Record):
    """A ground by its preset, by values, or by a preset of which values change something."""

    preset: str | None = declare("ground by name", default=None, choices=tuple(SOILS))
    shear_modulus_mpa: float | None = like("soil.shear_modulus_pa")
    plastic_mm: float | None = like(
        "soil.plastic_parameter_m",
        "plastic deformation under the static load (p); where only G is given: 0.8 mm (G/35 MPa)^−0.5686, "
        "scaled to the machine, an assumption",
    )
    density_kg_m3: float | None = like("soil.density_kg_m3")
    poisson_ratio: float | None = like("soil.poisson_ratio")

    def soil(self, machine: Machine, otherwise: Soil) -> Soil:
        """Return the model's soil under a machine.

        Parameters
        ----------
        machine : Machine
            The machine.
        otherwise : Soil
            What holds where nothing is said.

        Raises
        ------
        ParameterError
            If the soil that comes out is beyond the model's bounds.
        """
        soil = otherwise if self.preset is None else soil_preset(self.preset).soil(machine)
        if self.shear_modulus_mpa is not None:
            soil = replace(soil, shear_modulus_pa=self.shear_modulus_mpa * 1e6)
            if self.preset is None and self.plastic_mm is None:
                soil = replace(
                    soil, plastic_parameter_m=_covarying(self.shear_modulus_mpa, machine)
                )
        if self.plastic_mm is not None:
            soil = replace(soil, plastic_parameter_m=self.plastic_mm / 1e3)
        if self.density_kg_m3 is not None:
            soil = replace(soil, density_kg_m3=self.density_kg_m3)
        if self.poisson_ratio is not None:
            soil = replace(soil, poisson_ratio=self.poisson_ratio)
        return soil


def _covarying(shear_modulus_mpa: float, machine: Machine) -> float:
    fitted = covarying_plastic_parameter(shear_modulus_mpa * 1e6)
    return scaled_plastic_parameter(fitted, Machine(), machine)
