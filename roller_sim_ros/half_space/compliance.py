"""Exact dynamic compliance of the rectangle's centre: the function eq. (9) approximates."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from roller_sim_ros.half_space.checks import (
    HalfSpaceError,
    require_poisson_ratio,
    require_positive,
)
from roller_sim_ros.half_space.point_load import ComplexArray, FloatArray, point_load
from roller_sim_ros.half_space.point_load_harmonic import gauss_legendre, harmonic_displacement
from roller_sim_ros.half_space.rectangle import Side, sides, static_weight
from roller_sim_ros.half_space.static import static_compliance


def normalised_compliance(
    a0: npt.ArrayLike, aspect_ratio: float, poisson_ratio: float
) -> ComplexArray:
    """Exact H(i omega)/H0 at the centre of the rectangle.

    Parameters
    ----------
    a0 : array_like, any shape
        omega sqrt(BL)/v_s, eq. (8), not negative; complex with a negative imaginary part where the half
        space is damped.
    aspect_ratio : float
        alpha = L/B, positive.
    poisson_ratio : float
        nu, 0 <= nu < 0.5.

    Returns
    -------
    ndarray of complex, same shape
        H/H0 for exp(+i omega t): 1 at a0 = 0, imaginary part negative.

    Notes
    -----
    H/H0 = int m(r) S^(a0 r) dr / int m(r) dr over the distance r from the centre, by Gauss quadrature,
    one pair of sides at a time, with r = c cosh(psi) to remove the square root at r = c.
    """
    require_positive(aspect_ratio=aspect_ratio)
    require_poisson_ratio(poisson_ratio)
    frequencies = np.atleast_1d(np.asarray(a0))
    load = point_load(poisson_ratio)
    highest = float(np.abs(frequencies).max(initial=0.0)) * load.slowness_rayleigh
    distance, weight = _weight_rule(aspect_ratio, highest)
    values = harmonic_displacement(np.multiply.outer(frequencies, distance), load) @ weight
    return np.asarray(values.reshape(np.shape(a0)) / static_weight(aspect_ratio))


def _weight_rule(aspect_ratio: float, wavenumber: float) -> tuple[FloatArray, FloatArray]:
    """Nodes r and weights of int m(r) f(r) dr for an f that oscillates with up to `wavenumber`."""
    diagonal = math.sqrt(aspect_ratio + 1.0 / aspect_ratio)
    nodes: list[FloatArray] = []
    weights: list[FloatArray] = []

    def add(side: Side, r: FloatArray, measure: FloatArray) -> None:
        nodes.append(r)
        weights.append(side.weight(r * r) * measure)

    for side in sides(aspect_ratio):
        c = side.distance
        if not side.grows:
            unit, weight = gauss_legendre(24 + math.ceil(0.5 * wavenumber * c))
            add(side, c * unit, c * weight)
        span = math.acosh(diagonal / c)
        unit, weight = gauss_legendre(32 + math.ceil(0.75 * wavenumber * diagonal * span))
        add(side, c * np.cosh(span * unit), c * np.sinh(span * unit) * span * weight)
    return np.concatenate(nodes), np.concatenate(weights)


def exact_compliance(
    omega: npt.ArrayLike,
    shear_modulus_pa: float,
    density: float,
    poisson_ratio: float,
    half_width_m: float,
    half_length_m: float,
    hysteretic_damping: float = 0.0,
) -> ComplexArray:
    """Exact compliance H(i omega) of the rectangle's centre.

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
    half_width_m, half_length_m : float
        B (across which the stress is parabolic) and L, m.
    hysteretic_damping : float
        Damping ratio xi of the complex shear modulus G (1 + 2 i xi sgn omega), not negative.

    Returns
    -------
    ndarray of complex, same shape as `omega`
        Settlement per newton, m/N, for exp(+i omega t): H(0) = H0, imaginary part negative for omega > 0,
        H(-i omega) the conjugate.

    Raises
    ------
    HalfSpaceError
        If an argument is out of range.

    Notes
    -----
    The correspondence principle gives the damped half space: replace G by the complex modulus in H0 and
    in v_s, Poisson's ratio stays real. The static value of a damped half space is complex (its
    hysteresis does not depend on the rate); at omega = 0 itself it is the real H0.
    """
    if not (math.isfinite(hysteretic_damping) and hysteretic_damping >= 0.0):
        raise HalfSpaceError(f"hysteretic_damping = {hysteretic_damping!r} must not be negative")
    require_positive(density=density)
    h0 = static_compliance(shear_modulus_pa, poisson_ratio, half_width_m, half_length_m)
    angular = np.asarray(omega, dtype=np.float64)
    if not np.all(np.isfinite(angular)):
        raise HalfSpaceError("omega must be finite")
    unit_time = math.sqrt(half_width_m * half_length_m * density / shear_modulus_pa)
    a0 = np.abs(angular) * unit_time
    modulus = complex(1.0, 2.0 * hysteretic_damping)
    damped = a0 / np.sqrt(modulus) if hysteretic_damping > 0.0 else a0
    h = h0 * normalised_compliance(damped, half_length_m / half_width_m, poisson_ratio)
    if hysteretic_damping > 0.0:
        h = np.where(angular == 0.0, h, h / modulus)
    return np.asarray(np.where(angular < 0.0, np.conj(h), h))
