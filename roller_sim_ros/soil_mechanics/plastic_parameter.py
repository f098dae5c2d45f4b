# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The plastic parameter p from the strength of the ground: eqs (1) and (2) under a round drum.

A strip of half width B and the drum's width W bears, for friction material without cohesion and without
surcharge (eq. 2),

    Q_u = γ B N_γ · 2 B W.

The drum is no strip: the deeper it sinks, the wider it rests. With z the depth of its lowest point below the
flat surface before it came, and the circle taken for its parabola, the drum meets that surface at
x² = 2 r z, so

    B² = 2 r z,    Q_u = 4 γ N_γ W r z:

the load is proportional to the depth, which is why the plastic layer of eq. (13) is linear. Ground that heaves
beside the drum is left out, as is the circle's own z² (a share z/2r of B², 0.3 % for 5 mm). The depth under the
static load is p:

    p = (F_stat / W) / (4 γ N_γ r).

The textbook's B is that of the zone at failure, and its φ that of the plane, at the low stress under a drum;
so φ is the peak angle in plane strain, some 40 to 50°, and p is very sensitive to it: 2° more take a third of it.
"""

from __future__ import annotations

import math

from roller_sim_ros.parameters import Machine, ParameterError


def plastic_parameter(
    unit_weight_n_m3: float, n_gamma: float, line_load_n_m: float, drum_radius_m: float
) -> float:
    """Return p = line load / (4 γ N_γ r), m.

    Parameters
    ----------
    unit_weight_n_m3 : float
        γ, N/m³.
    n_gamma : float
        Bearing capacity factor N_γ; none bears nothing, so it must be positive.
    line_load_n_m : float
        F_stat / W, N/m.
    drum_radius_m : float
        r, m.

    Raises
    ------
    ParameterError
        If one of them is not positive and finite.
    """
    _require_positive(
        unit_weight_n_m3=unit_weight_n_m3,
        n_gamma=n_gamma,
        line_load_n_m=line_load_n_m,
        drum_radius_m=drum_radius_m,
    )
    return line_load_n_m / (4.0 * unit_weight_n_m3 * n_gamma * drum_radius_m)


def contact_half_width(depth_m: float, drum_radius_m: float) -> float:
    """Return B = √(2 r z) of a drum that has sunk by z into a flat surface, m."""
    return math.sqrt(2.0 * drum_radius_m * depth_m)


def line_load(machine: Machine) -> float:
    """Return F_stat / W of a machine, N/m."""
    return machine.static_load_n / machine.drum_width_m


def scaled_plastic_parameter(
    plastic_parameter_m: float, measured_with: Machine, machine: Machine
) -> float:
    """Return the p that the same ground has under another machine, m.

    p goes with the line load over the drum's radius.

    Parameters
    ----------
    plastic_parameter_m : float
        p under the machine it is known for, m.
    measured_with, machine : Machine
        That machine, and the other.
    """
    loads = line_load(machine) / line_load(measured_with)
    return plastic_parameter_m * loads * measured_with.drum_radius_m / machine.drum_radius_m


def _require_positive(**values: float) -> None:
    for name, value in values.items():
        if not (value > 0.0 and math.isfinite(value)):
            raise ParameterError(name, value, "must be positive")
