# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The paper's own half space: eq. (9) of second order, H = H0/(1 + s/(Q omega0) + s^2/omega0^2)."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from roller_sim_ros.half_space.checks import require_positive
from roller_sim_ros.half_space.point_load import ComplexArray
from roller_sim_ros.half_space.static import static_compliance

QUALITY_FACTOR = 0.4
"""Q: the paper lowered the calculated 0.6 to agree with measurements (internal damping)."""

FREQUENCY_FACTOR = 2.75
"""omega0 sqrt(BL)/v_s: the best second-order fit of a square with this stress, unpublished by the paper."""


def two_pole_frequency(
    shear_modulus_pa: float,
    density: float,
    half_width_m: float,
    half_length_m: float,
    frequency_factor: float = FREQUENCY_FACTOR,
) -> float:
    """Natural frequency omega0 = factor * v_s/sqrt(BL), rad/s.

    Parameters
    ----------
    shear_modulus_pa : float
        G, Pa.
    density : float
        rho, kg/m^3.
    half_width_m, half_length_m : float
        B and L, m. Only the area counts: the paper reshapes it to the aspect ratio of its data.
    frequency_factor : float
        omega0 sqrt(BL)/v_s.

    Returns
    -------
    float
        omega0, rad/s.
    """
    require_positive(
        shear_modulus_pa=shear_modulus_pa,
        density=density,
        half_width_m=half_width_m,
        half_length_m=half_length_m,
        frequency_factor=frequency_factor,
    )
    shear_wave_speed = math.sqrt(shear_modulus_pa / density)
    return frequency_factor * shear_wave_speed / math.sqrt(half_width_m * half_length_m)


def two_pole_compliance(
    omega: npt.ArrayLike,
    shear_modulus_pa: float,
    density: float,
    poisson_ratio: float,
    half_width_m: float,
    half_length_m: float,
    quality_factor: float = QUALITY_FACTOR,
    frequency_factor: float = FREQUENCY_FACTOR,
    formula: str = "exact",
) -> ComplexArray:
    """Compliance of the second-order half space, eq. (9) with a constant numerator.

    Parameters
    ----------
    omega : array_like, any shape
        Angular frequency, rad/s.
    shear_modulus_pa, density, poisson_ratio, half_width_m, half_length_m : float
        G (Pa), rho (kg/m^3), nu, B and L (m).
    quality_factor : float
        Q.
    frequency_factor : float
        omega0 sqrt(BL)/v_s.
    formula : {"exact", "paper"}
        How the static compliance is computed, see `static.influence_integral`.

    Returns
    -------
    ndarray of complex, same shape
        Settlement per newton, m/N, for exp(+i omega t).
    """
    require_positive(quality_factor=quality_factor)
    omega0 = two_pole_frequency(
        shear_modulus_pa, density, half_width_m, half_length_m, frequency_factor
    )
    h0 = static_compliance(shear_modulus_pa, poisson_ratio, half_width_m, half_length_m, formula)
    s = 1j * np.asarray(omega, dtype=np.float64) / omega0
    return np.asarray(h0 / (1.0 + s / quality_factor + s * s))
