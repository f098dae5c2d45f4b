# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the ground is, in the terms of soil mechanics: eqs (1) to (4), and grounds and rollers by name.

Where things are:

- ``bearing_capacity``: N_q, N_c and two N_γ, eq. (1)
- ``plastic_parameter``: p from them, eqs (1) and (2), and from one machine to another
- ``small_strain_stiffness``: G_max from void ratio and stress, eqs (3) and (4)
- ``granular_soil``: a ground given by (e, φ, γ, K_0, …) as the model's soil
- ``soil_presets``, ``machine_presets``: grounds and rollers by name, with their sources
"""

from roller_sim_ros.soil_mechanics.bearing_capacity import (
    N_GAMMA,
    bearing_capacity,
    n_c,
    n_gamma_meyerhof,
    n_gamma_vesic,
    n_q,
)
from roller_sim_ros.soil_mechanics.granular_soil import GranularSoil
from roller_sim_ros.soil_mechanics.machine_presets import MACHINES, MachinePreset, machine_preset
from roller_sim_ros.soil_mechanics.plastic_parameter import (
    contact_half_width,
    line_load,
    plastic_parameter,
    scaled_plastic_parameter,
)
from roller_sim_ros.soil_mechanics.small_strain_stiffness import (
    GRAINS,
    mean_effective_stress,
    small_strain_modulus,
)
from roller_sim_ros.soil_mechanics.soil_presets import SOILS, FittedSoil, SoilPreset, soil_preset

__all__ = [
    "GRAINS",
    "MACHINES",
    "N_GAMMA",
    "SOILS",
    "FittedSoil",
    "GranularSoil",
    "MachinePreset",
    "SoilPreset",
    "bearing_capacity",
    "contact_half_width",
    "line_load",
    "machine_preset",
    "mean_effective_stress",
    "n_c",
    "n_gamma_meyerhof",
    "n_gamma_vesic",
    "n_q",
    "plastic_parameter",
    "scaled_plastic_parameter",
    "small_strain_modulus",
    "soil_preset",
]
