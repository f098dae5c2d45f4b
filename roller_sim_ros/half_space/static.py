# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Static compliance of the loaded rectangle on the half space: eqs (5), (6) and (7)."""

from __future__ import annotations

import math

from roller_sim_ros.half_space.checks import (
    HalfSpaceError,
    require_poisson_ratio,
    require_positive,
)


def influence_integral(aspect_ratio: float, formula: str = "exact") -> float:
    """Boussinesq influence integral I(alpha) of the rectangle's centre.

    The stress is parabolic across the half width B and constant along the half length L.

    Parameters
    ----------
    aspect_ratio : float
        alpha = L/B, greater than zero.
    formula : {"exact", "paper"}
        ``"exact"`` is the integral in closed form, ``"paper"`` the approximation
        0.66 ln(7.9 alpha) of eq. (6), which is within 0.4 % for alpha from 2 to 100 (-1.2 % at 1).

    Returns
    -------
    float
        I(alpha), dimensionless.

    Raises
    ------
    HalfSpaceError
        If `aspect_ratio` is not positive and finite, if `formula` is unknown, or if the paper's
        formula is asked for an aspect ratio at which it is not positive (alpha <= 1/7.9).

    Notes
    -----
    Sandström (1994), eqs (5) and (6). Integrating 1/r over the rectangle gives

        I = (2/3) asinh(alpha) + (alpha + alpha^3/6) asinh(1/alpha) - (alpha/6) sqrt(1 + alpha^2).
    """
    require_positive(aspect_ratio=aspect_ratio)
    if formula == "paper":
        if aspect_ratio <= 1.0 / 7.9:
            raise HalfSpaceError(
                f"aspect_ratio = {aspect_ratio!r}: eq. (6) needs more than 1/7.9; use 'exact'"
            )
        return 0.66 * math.log(7.9 * aspect_ratio)
    if formula != "exact":
        raise HalfSpaceError(f"formula = {formula!r} must be 'exact' or 'paper'")
    return (
        (2.0 / 3.0) * math.asinh(aspect_ratio)
        + (aspect_ratio + aspect_ratio**3 / 6.0) * math.asinh(1.0 / aspect_ratio)
        - aspect_ratio / 6.0 * math.sqrt(1.0 + aspect_ratio**2)
    )


def static_compliance(
    shear_modulus_pa: float,
    poisson_ratio: float,
    half_width_m: float,
    half_length_m: float,
    formula: str = "exact",
) -> float:
    """Static compliance H0 = D (1 - nu)/(G B) of the rectangle's centre, eqs (5) and (7).

    Parameters
    ----------
    shear_modulus_pa : float
        Shear modulus G of the half space, Pa.
    poisson_ratio : float
        Poisson's ratio nu, 0 <= nu < 0.5.
    half_width_m, half_length_m : float
        Half width B (across which the stress is parabolic) and half length L, m.
    formula : {"exact", "paper"}
        How I(alpha) is computed, see `influence_integral`.

    Returns
    -------
    float
        H0, m/N: settlement of the centre (positive down) for each newton of total load.

    Raises
    ------
    HalfSpaceError
        If a length or the modulus is not positive and finite or nu is out of range.
    """
    require_positive(
        shear_modulus_pa=shear_modulus_pa, half_width_m=half_width_m, half_length_m=half_length_m
    )
    require_poisson_ratio(poisson_ratio)
    aspect_ratio = half_length_m / half_width_m
    displacement = 3.0 * influence_integral(aspect_ratio, formula) / (4.0 * math.pi * aspect_ratio)
    return displacement * (1.0 - poisson_ratio) / (shear_modulus_pa * half_width_m)
