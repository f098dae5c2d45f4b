# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The elastic half space below the plastic layer, loaded by the drum's strip (paper, eqs 5 to 10).

Where things are:

- ``static``: influence integral I(alpha) and static compliance H0, eqs (5) to (7)
- ``point_load``: what a point load's step does to the surface (Pekeris), Rayleigh speed
- ``rectangle``: how much of the strip's load lies at each distance from its centre
- ``transient``, ``transient_kernel``: the two together, in closed form: step response and ramp
- ``step_response``: the transient as a table, and its FIR taps, for comparison with other implementations
- ``compliance``: exact compliance H(i omega), the transform of the transient
- ``point_load_harmonic``: what a harmonic point load does
- ``two_pole``: the paper's second-order half space
- ``rational``, ``rational_fit``: eq. (9) of any order, fitted by linear programming
- ``circular``: circular loads, Sung's functions (Figure 7)
- ``radiation``: how the radiated energy divides into Rayleigh, shear and compression waves
- ``hysteresis``: hysteretic damping, for any dimensionless compliance
- ``quadrature``: Gauss rules
- ``checks``: argument checks and `HalfSpaceError`
"""

from roller_sim_ros.half_space.checks import HalfSpaceError
from roller_sim_ros.half_space.circular import circular_compliance, sung_functions
from roller_sim_ros.half_space.compliance import exact_compliance, normalised_compliance
from roller_sim_ros.half_space.point_load import rayleigh_slowness
from roller_sim_ros.half_space.radiation import RadiatedEnergy, radiated_energy
from roller_sim_ros.half_space.rational import (
    RationalHalfSpace,
    rational_compliance,
    rational_half_space,
)
from roller_sim_ros.half_space.static import influence_integral, static_compliance
from roller_sim_ros.half_space.step_response import (
    StepResponse,
    ramp_at,
    step_at,
    step_response,
    taps,
)
from roller_sim_ros.half_space.two_pole import two_pole_compliance, two_pole_frequency

__all__ = [
    "HalfSpaceError",
    "influence_integral",
    "static_compliance",
    "rayleigh_slowness",
    "StepResponse",
    "step_response",
    "ramp_at",
    "step_at",
    "taps",
    "exact_compliance",
    "normalised_compliance",
    "two_pole_frequency",
    "two_pole_compliance",
    "RationalHalfSpace",
    "rational_half_space",
    "rational_compliance",
    "sung_functions",
    "circular_compliance",
    "RadiatedEnergy",
    "radiated_energy",
]
