# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Bearing capacity of a strip on the surface of the ground: eq. (1) and its factors.

The factors depend on the friction angle φ alone. N_q and N_c are exact for weightless ground; for N_γ, which
has no closed form, there are as many formulas as authors, and they differ: two are here, by their names.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from roller_sim_ros.parameters import ParameterError

LARGEST_FRICTION_ANGLE_RAD = math.radians(60.0)
"""Beyond this no granular ground is known; N_γ is some 10⁴ there and grows without bound towards 90°."""


def n_q(friction_angle_rad: float) -> float:
    """Return N_q, what a surcharge bears: exp(π tan φ) tan²(45° + φ/2) (Prandtl 1920, Reissner 1924).

    Parameters
    ----------
    friction_angle_rad : float
        φ, rad, 0 to 60°.

    Raises
    ------
    ParameterError
        If φ is out of range; so do the other factors.
    """
    return 1.0 + _n_q_less_one(friction_angle_rad)


def n_c(friction_angle_rad: float) -> float:
    """Return N_c, what cohesion bears: (N_q − 1) cot φ, 2 + π without friction (Prandtl 1920)."""
    if friction_angle_rad == 0.0:
        return 2.0 + math.pi
    return _n_q_less_one(friction_angle_rad) / math.tan(friction_angle_rad)


def n_gamma_vesic(friction_angle_rad: float) -> float:
    """Return N_γ, what the ground's own weight bears, as Vesić (1973) has it: 2 (N_q + 1) tan φ."""
    return 2.0 * (n_q(friction_angle_rad) + 1.0) * math.tan(friction_angle_rad)


def n_gamma_meyerhof(friction_angle_rad: float) -> float:
    """Return N_γ as Meyerhof (1963) has it: (N_q − 1) tan 1.4 φ."""
    return _n_q_less_one(friction_angle_rad) * math.tan(1.4 * friction_angle_rad)


N_GAMMA: dict[str, Callable[[float], float]] = {
    "vesic": n_gamma_vesic,
    "meyerhof": n_gamma_meyerhof,
}
"""N_γ of φ by the name of its author."""


def bearing_capacity(
    friction_angle_rad: float,
    half_width_m: float,
    unit_weight_n_m3: float,
    *,
    cohesion_pa: float = 0.0,
    surcharge_pa: float = 0.0,
    n_gamma: str = "vesic",
) -> float:
    """Return the mean stress at failure under a strip: s_u = c N_c + q N_q + B γ N_γ.

    Parameters
    ----------
    friction_angle_rad : float
        φ, rad.
    half_width_m : float
        B, half the strip's width, m.
    unit_weight_n_m3 : float
        γ of the ground, N/m³.
    cohesion_pa, surcharge_pa : float
        c, and q on the surface beside the strip, Pa.
    n_gamma : str
        Whose N_γ, a key of `N_GAMMA`.

    Returns
    -------
    float
        s_u, Pa.

    Raises
    ------
    ParameterError
        If φ is out of range or the author unknown.

    Notes
    -----
    Sandström (1994), eq. (1). With B as half the width, B γ N_γ is the usual ½ (2B) γ N_γ.
    """
    weight = half_width_m * unit_weight_n_m3 * n_gamma_of(n_gamma, friction_angle_rad)
    return cohesion_pa * n_c(friction_angle_rad) + surcharge_pa * n_q(friction_angle_rad) + weight


def n_gamma_of(author: str, friction_angle_rad: float) -> float:
    """Return N_γ by the name of its author.

    Raises
    ------
    ParameterError
        If the author is none of `N_GAMMA`.
    """
    if author not in N_GAMMA:
        raise ParameterError("n_gamma", author, f"must be one of {', '.join(N_GAMMA)}")
    return N_GAMMA[author](friction_angle_rad)


def _n_q_less_one(friction_angle_rad: float) -> float:
    """Return N_q − 1 with all digits also where φ is small: 2 ln tan(45° + φ/2) = 2 artanh sin φ."""
    if not 0.0 <= friction_angle_rad <= LARGEST_FRICTION_ANGLE_RAD:
        raise ParameterError("friction_angle_rad", friction_angle_rad, "must be 0 … 1.0472 (60°)")
    return math.expm1(
        math.pi * math.tan(friction_angle_rad) + 2.0 * math.atanh(math.sin(friction_angle_rad))
    )
