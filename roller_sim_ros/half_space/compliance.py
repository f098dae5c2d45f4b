# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Exact dynamic compliance of the rectangle's centre: the function eq. (9) approximates."""

from __future__ import annotations

import functools
import itertools
import math

import numpy as np
import numpy.typing as npt

from roller_sim_ros.half_space.checks import require_poisson_ratio, require_positive
from roller_sim_ros.half_space.hysteresis import over_frequency
from roller_sim_ros.half_space.point_load import ComplexArray, FloatArray
from roller_sim_ros.half_space.quadrature import gauss_legendre
from roller_sim_ros.half_space.static import static_compliance
from roller_sim_ros.half_space.transient import step_and_ramp, wave_fronts

_CHUNK = 200_000  # exponentials at a time


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

    Raises
    ------
    HalfSpaceError
        If alpha or nu is out of range.

    Notes
    -----
    The response to a step is complete after the memory T, hence

        H/H0 = 1 - i a0 int_0^T (1 - s) exp(-i a0 tau) d tau,

    without anything at infinity, for complex a0 too. Gauss quadrature between the wave fronts, where s
    has square roots and logarithms; accurate to 1e-10 (alpha up to 60).
    """
    require_positive(aspect_ratio=aspect_ratio)
    require_poisson_ratio(poisson_ratio)
    frequencies = np.asarray(a0).ravel()
    highest = float(np.abs(frequencies).max(initial=0.0))
    resolved = 2.0 ** math.ceil(math.log2(max(highest, 1.0)))
    tau, remainder = _remainder_rule(float(aspect_ratio), float(poisson_ratio), resolved)
    values = np.empty(frequencies.size, dtype=np.complex128)
    rows = max(1, _CHUNK // tau.size)
    for start in range(0, frequencies.size, rows):
        part = frequencies[start : start + rows]
        values[start : start + rows] = 1.0 - 1j * part * (
            np.exp(-1j * np.outer(part, tau)) @ remainder
        )
    return values.reshape(np.shape(a0))


@functools.lru_cache(maxsize=64)
def _remainder_rule(
    aspect_ratio: float, poisson_ratio: float, highest: float
) -> tuple[FloatArray, FloatArray]:
    """Nodes tau and weights times 1 - s, for exponentials up to the frequency `highest`."""
    nodes, weights = [], []
    fronts = [0.0, *wave_fronts(aspect_ratio, poisson_ratio)]
    for first, last in itertools.pairwise(fronts):
        length = last - first
        unit, weight = gauss_legendre(48 + math.ceil(0.4 * highest * length))
        nodes.append(first + length * unit**2 * (3.0 - 2.0 * unit))
        weights.append(length * 6.0 * unit * (1.0 - unit) * weight)
    tau = np.concatenate(nodes)
    step, _ = step_and_ramp(tau, aspect_ratio, poisson_ratio)
    return tau, np.concatenate(weights) * (1.0 - step)


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
    """
    require_positive(density=density)
    h0 = static_compliance(shear_modulus_pa, poisson_ratio, half_width_m, half_length_m)
    aspect_ratio = half_length_m / half_width_m
    unit_time = math.sqrt(half_width_m * half_length_m * density / shear_modulus_pa)
    return h0 * over_frequency(
        lambda a0: normalised_compliance(a0, aspect_ratio, poisson_ratio),
        omega,
        unit_time,
        hysteretic_damping,
    )
