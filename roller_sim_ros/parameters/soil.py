# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ground: elastic half space and plastic layer (paper, 'Soil model')."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.parameters.quantity import ParameterGroup, parameter

COVARIATION_EXPONENT = -0.5686


@dataclass(frozen=True)
class Soil(ParameterGroup):
    """Shear modulus, plastic parameter and the secondary constants of the ground."""

    group: ClassVar[str] = "soil"

    shear_modulus_pa: float = parameter(
        50e6,
        "Pa",
        "shear modulus of the half space (G)",
        minimum=2e6,
        maximum=1e9,
        live=True,
        flag="--shear-modulus-mpa",
        scale=1e6,
        flag_unit="MPa",
    )
    plastic_parameter_m: float = parameter(
        0.65e-3,
        "m",
        "plastic deformation under the static load (p)",
        minimum=2e-5,
        maximum=2e-2,
        live=True,
        flag="--plastic-mm",
        scale=1e-3,
        flag_unit="mm",
    )
    density_kg_m3: float = parameter(
        2000.0,
        "kg/m³",
        "density of the ground (ρ)",
        minimum=1000.0,
        maximum=3500.0,
        live=True,
        flag="--density-kg-m3",
        flag_unit="kg/m³",
    )
    poisson_ratio: float = parameter(
        0.25,
        "",
        "Poisson's ratio (ν)",
        minimum=0.0,
        maximum=0.49,
        live=True,
        flag="--poisson-ratio",
    )


def covarying_plastic_parameter(shear_modulus_pa: float) -> float:
    """Return the p that goes with a G, in m: the power law through the two points of Figure 14.

    p = 0.8 mm (G / 35 MPa)^−0.5686. The paper's text gives only (35 MPa, 0.8 mm) and (80 MPa, 0.5 mm); the
    curve between them is this project's assumption.
    """
    return float(0.8e-3 * (shear_modulus_pa / 35e6) ** COVARIATION_EXPONENT)
