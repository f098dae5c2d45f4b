# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Compliance of circular loads: uniform, parabolic and that under a rigid disc (Figure 7).

The stress of the three is 1/(pi r0^2), 2 (1 - r^2/r0^2)/(pi r0^2) and 1/(2 pi r0 sqrt(r0^2 - r^2)) for a
unit load; the last is the static one under a rigid disc, kept at all frequencies as Reissner and Sung did.
"""

from __future__ import annotations

import functools
import math

import numpy as np
import numpy.typing as npt

from roller_sim_ros.half_space.checks import HalfSpaceError, require_positive
from roller_sim_ros.half_space.hysteresis import over_frequency
from roller_sim_ros.half_space.point_load import ComplexArray, FloatArray, point_load
from roller_sim_ros.half_space.point_load_harmonic import harmonic_displacement
from roller_sim_ros.half_space.quadrature import gauss_legendre

LOADS = ("uniform", "parabolic", "rigid")
DISPLACEMENTS = ("centre", "average")


def sung_functions(
    a0: npt.ArrayLike, poisson_ratio: float, load: str, displacement: str = "centre"
) -> ComplexArray:
    """Dimensionless compliance f1 + i f2 = G r0 H of a circular load.

    Parameters
    ----------
    a0 : array_like, any shape
        omega r0/v_s, eq. (8), not negative; complex with a negative imaginary part where the half space is
        damped.
    poisson_ratio : float
        nu, 0 <= nu < 0.5.
    load : {"uniform", "parabolic", "rigid"}
        Distribution of the stress.
    displacement : {"centre", "average"}
        Of the centre, as Sung has it, or the average weighted by the stress, which is conjugate to the load:
        its imaginary part is never positive.

    Returns
    -------
    ndarray of complex, same shape
        For exp(+i omega t): imaginary part negative, f2 of Reissner and Sung with its sign changed.

    Raises
    ------
    HalfSpaceError
        If nu is out of range, the load or the displacement unknown.

    Notes
    -----
    Sung (1953). H = (1 - nu)/(2 pi G) int m(d) S^(omega d/v_s) dd with the point load's S^ and the weight
    m of the distance d: 2 pi q(d) from the centre, 2 pi times the autocorrelation of q for the average.
    """
    if load not in LOADS:
        raise HalfSpaceError(f"load = {load!r} must be one of {', '.join(LOADS)}")
    if displacement not in DISPLACEMENTS:
        raise HalfSpaceError(
            f"displacement = {displacement!r} must be one of {', '.join(DISPLACEMENTS)}"
        )
    constants = point_load(poisson_ratio)
    frequencies = np.asarray(a0)
    highest = float(np.abs(frequencies).max(initial=0.0))
    distance, weight = _weights(load, displacement, 60 + 2 * math.ceil(highest))
    point = harmonic_displacement(np.multiply.outer(frequencies, distance), constants)
    return np.asarray((1.0 - poisson_ratio) / (2.0 * math.pi) * (point @ weight))


@functools.lru_cache(maxsize=32)
def _weights(load: str, displacement: str, count: int) -> tuple[FloatArray, FloatArray]:
    """Nodes d/r0 and weights of int m(d) f(d) dd."""
    unit, weight = gauss_legendre(count)
    if displacement == "centre":
        # d = sin(x) takes the edge of the rigid disc.
        x = 0.5 * math.pi * unit
        d, measure = np.sin(x), 0.5 * math.pi * weight
        if load == "rigid":
            return d, measure
        return d, measure * np.cos(x) * (2.0 if load == "uniform" else 4.0 * (1.0 - d * d))
    # d = 2 sin(x), x = pi/2 y^3: smooth at the far end, gentle at the logarithm of the rigid disc.
    x = 0.5 * math.pi * unit**3
    d, root = 2.0 * np.sin(x), 2.0 * np.cos(x)  # root = sqrt(4 - d^2)
    measure = root * 1.5 * math.pi * unit**2 * weight
    angle = 0.5 * math.pi - x  # arccos(d/2)
    if load == "uniform":
        m = (4.0 * angle - d * root) / math.pi
    elif load == "parabolic":
        m = (16.0 / 3.0 - 8.0 * d**2) * angle + d * root * (12.0 + 16.0 * d**2 - d**4) / 9.0
        m = m / math.pi
    else:
        m = 0.5 * np.arccosh(2.0 / d)
    return d, m * measure


def circular_compliance(
    omega: npt.ArrayLike,
    shear_modulus_pa: float,
    density: float,
    poisson_ratio: float,
    radius_m: float,
    load: str,
    displacement: str = "centre",
    hysteretic_damping: float = 0.0,
) -> ComplexArray:
    """Compliance H(i omega) of a circular load.

    Parameters
    ----------
    omega : array_like, any shape
        Angular frequency, rad/s, of either sign.
    shear_modulus_pa : float
        G, Pa.
    density : float
        rho, kg/m^3.
    poisson_ratio : float
        nu, 0 <= nu < 0.5.
    radius_m : float
        r0, m.
    load, displacement : str
        See `sung_functions`.
    hysteretic_damping : float
        Damping ratio xi of the complex shear modulus G (1 + 2 i xi sgn omega), not negative.

    Returns
    -------
    ndarray of complex, same shape
        Settlement per newton, m/N, for exp(+i omega t).

    Raises
    ------
    HalfSpaceError
        If an argument is out of range.
    """
    require_positive(shear_modulus_pa=shear_modulus_pa, density=density, radius_m=radius_m)
    return over_frequency(
        lambda a0: sung_functions(a0, poisson_ratio, load, displacement),
        omega,
        radius_m * math.sqrt(density / shear_modulus_pa),
        hysteretic_damping,
    ) / (shear_modulus_pa * radius_m)
