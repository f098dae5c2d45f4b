# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ground as soil mechanics describes it, and what the drum/soil model makes of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.parameters import GRAVITY_M_S2, Machine, Soil
from roller_sim_ros.parameters.quantity import ParameterGroup, parameter
from roller_sim_ros.soil_mechanics.bearing_capacity import N_GAMMA, n_gamma_of
from roller_sim_ros.soil_mechanics.plastic_parameter import line_load, plastic_parameter
from roller_sim_ros.soil_mechanics.small_strain_stiffness import (
    GRAINS,
    mean_effective_stress,
    small_strain_modulus,
)


@dataclass(frozen=True)
class GranularSoil(ParameterGroup):
    """Ground without cohesion; the defaults are the preset ``medium-gravel``.

    Poisson's ratio has no flag here: the soil's own parameter has it.
    """

    group: ClassVar[str] = "granular"

    void_ratio: float = parameter(
        0.45,
        "",
        "void ratio (e), for the shear modulus",
        minimum=0.15,
        maximum=1.5,
        flag="--void-ratio",
    )
    friction_angle_rad: float = parameter(
        0.7853981633974483,
        "rad",
        "peak friction angle in plane strain (φ), for the plastic parameter",
        minimum=0.3490658503988659,
        maximum=1.0471975511965976,
        flag="--friction-angle-deg",
        scale=0.017453292519943295,
        flag_unit="deg",
    )
    unit_weight_n_m3: float = parameter(
        18830.0,
        "N/m³",
        "unit weight (γ), also for the density",
        minimum=10e3,
        maximum=34e3,
        flag="--unit-weight-kn-m3",
        scale=1e3,
        flag_unit="kN/m³",
    )
    earth_pressure_coefficient: float = parameter(
        0.6,
        "",
        "horizontal over vertical stress at rest (K_0), for the shear modulus; grows with compaction",
        minimum=0.1,
        maximum=5.0,
        flag="--k0",
    )
    depth_m: float = parameter(
        1.0,
        "m",
        "depth whose stress is taken for the shear modulus of the whole half space",
        minimum=0.05,
        maximum=20.0,
        flag="--depth-m",
        flag_unit="m",
    )
    grains: str = parameter(
        "round",
        "",
        "shape of the grains, for the shear modulus",
        choices=tuple(GRAINS),
        flag="--grains",
    )
    n_gamma: str = parameter(
        "vesic",
        "",
        "whose bearing capacity factor N_γ, for the plastic parameter",
        choices=tuple(N_GAMMA),
        flag="--n-gamma",
    )
    poisson_ratio: float = parameter(0.25, "", "Poisson's ratio (ν)", minimum=0.0, maximum=0.49)

    def soil(self, machine: Machine) -> Soil:
        """Return the model's soil under a machine: G_max, p from eqs (1) and (2), ρ = γ/g.

        Raises
        ------
        ParameterError
            If G or p comes out beyond the model's bounds.
        """
        stress_pa = mean_effective_stress(
            self.unit_weight_n_m3, self.depth_m, self.earth_pressure_coefficient
        )
        return Soil(
            shear_modulus_pa=small_strain_modulus(self.void_ratio, stress_pa, self.grains),
            plastic_parameter_m=plastic_parameter(
                self.unit_weight_n_m3,
                n_gamma_of(self.n_gamma, self.friction_angle_rad),
                line_load(machine),
                machine.drum_radius_m,
            ),
            density_kg_m3=self.unit_weight_n_m3 / GRAVITY_M_S2,
            poisson_ratio=self.poisson_ratio,
        )
