# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Vertical surface displacement under a point load that is applied as a step (Pekeris).

At the distance r from a vertical force that jumps from 0 to F at t = 0 the surface settles by

    u(r, t) = F (1 - nu)/(2 pi G r) S(x),    x = t v_s/r,

with, for a = v_s/v_p and gamma = v_s/c_R (c_R the Rayleigh wave's speed),

    S = 0                                                                       x < a,
    S = 1/2 [1 - A/sqrt(gamma^2 - x^2) - sum_j A_j/sqrt(x^2 - kappa_j^2)]       a < x < 1,
    S = 1 - A/sqrt(gamma^2 - x^2)                                               1 < x < gamma,
    S = 1                                                                       x > gamma.

kappa_j^2 are the two roots besides gamma^2 of the rationalised Rayleigh equation: real below
nu = 0.2631, a complex pair above, where the sum is twice the real part of one of its terms.
Pekeris (1955), Mooney (1974), Kausel (2012).
"""

from __future__ import annotations

import cmath
import functools
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roller_sim_ros.half_space.checks import require_poisson_ratio

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

# The two body-wave roots coincide near nu = 0.2631 and their residues then cancel each other.
# Moving 2 a^2 by this much keeps them apart and changes the response by less than 1e-10.
_LEAST_ROOT_GAP = 1e-6
_NUDGE = 1e-11


@dataclass(frozen=True)
class BodyWaveRoot:
    """One term A_j/sqrt(x^2 - kappa_j^2) of the response before the shear wave.

    Attributes
    ----------
    kappa_squared : complex
        kappa_j^2; its imaginary part is zero or positive.
    amplitude : complex
        A_j, times 2 where the term stands for a complex pair (the real part is to be taken).
    """

    kappa_squared: complex
    amplitude: complex


@dataclass(frozen=True)
class PointLoad:
    """Constants of the transient S(x) for one Poisson's ratio, all dimensionless.

    Attributes
    ----------
    poisson_ratio : float
        nu.
    slowness_p : float
        a = v_s/v_p: arrival of the P wave on the scale x = t v_s/r. The S wave arrives at 1.
    slowness_rayleigh : float
        gamma = v_s/c_R, arrival of the Rayleigh wave: S = 1 from there on.
    rayleigh_amplitude : float
        A, the strength of the Rayleigh wave's singularity.
    body_roots : tuple of BodyWaveRoot
        Two real roots or one that stands for a complex pair.
    """

    poisson_ratio: float
    slowness_p: float
    slowness_rayleigh: float
    rayleigh_amplitude: float
    body_roots: tuple[BodyWaveRoot, ...]

    @functools.cached_property
    def root_constants(self) -> ComplexArray:
        """Return kappa_j^2 and A_j in rows, for kernels, shape (len(body_roots), 2)."""
        rows = [(root.kappa_squared, root.amplitude) for root in self.body_roots]
        return np.array(rows, dtype=np.complex128).reshape(-1, 2)


def slowness_ratio_squared(poisson_ratio: float) -> float:
    """Return a^2 = (v_s/v_p)^2 = (1 - 2 nu)/(2 (1 - nu))."""
    return (1.0 - 2.0 * poisson_ratio) / (2.0 * (1.0 - poisson_ratio))


def rayleigh_slowness(poisson_ratio: float) -> float:
    """Return gamma = v_s/c_R, the shear wave's speed over the Rayleigh wave's.

    Parameters
    ----------
    poisson_ratio : float
        nu, 0 <= nu < 0.5.

    Returns
    -------
    float
        gamma, between 1.046 (nu 0.5) and 1.144 (nu 0).
    """
    return point_load(poisson_ratio).slowness_rayleigh


@functools.lru_cache(maxsize=256)
def point_load(poisson_ratio: float) -> PointLoad:
    """Solve the Rayleigh equation and return the constants of the point load's transient.

    Parameters
    ----------
    poisson_ratio : float
        nu, 0 <= nu < 0.5.

    Returns
    -------
    PointLoad

    Raises
    ------
    HalfSpaceError
        If nu is out of range.
    """
    require_poisson_ratio(poisson_ratio)
    a_squared = slowness_ratio_squared(poisson_ratio)
    gamma_squared, first, second = _rayleigh_roots(a_squared)
    if abs(first - second) < _LEAST_ROOT_GAP:
        a_squared += _NUDGE
        gamma_squared, first, second = _rayleigh_roots(a_squared)

    def amplitude(root: complex, other: complex, another: complex, radicand: complex) -> complex:
        return (root - 0.5) ** 2 * cmath.sqrt(radicand) / ((root - other) * (root - another))

    rayleigh = amplitude(gamma_squared, first, second, gamma_squared - a_squared).real
    if first.imag != 0.0:
        pair = first if first.imag > 0.0 else second
        strength = amplitude(pair, gamma_squared, pair.conjugate(), a_squared - pair)
        roots: tuple[BodyWaveRoot, ...] = (BodyWaveRoot(pair, 2.0 * strength),)
    else:
        roots = tuple(
            BodyWaveRoot(root, amplitude(root, gamma_squared, other, max(a_squared - root.real, 0)))
            for root, other in ((first, second), (second, first))
        )
        roots = tuple(root for root in roots if root.amplitude != 0.0)  # nu = 0: kappa = a
    return PointLoad(
        poisson_ratio=poisson_ratio,
        slowness_p=math.sqrt(a_squared),
        slowness_rayleigh=math.sqrt(gamma_squared),
        rayleigh_amplitude=rayleigh,
        body_roots=roots,
    )


def _rayleigh_roots(a_squared: float) -> tuple[float, complex, complex]:
    """Roots y = kappa^2 of 1 - 8 y + 8 (3 - 2 a^2) y^2 - 16 (1 - a^2) y^3 = 0, gamma^2 first."""
    cubic, square = -16.0 * (1.0 - a_squared), 8.0 * (3.0 - 2.0 * a_squared)
    gamma_squared = 1.3  # right of the largest root, where the cubic is monotone: Newton converges
    for _ in range(50):
        value = ((cubic * gamma_squared + square) * gamma_squared - 8.0) * gamma_squared + 1.0
        slope = (3.0 * cubic * gamma_squared + 2.0 * square) * gamma_squared - 8.0
        step = value / slope
        gamma_squared -= step
        if abs(step) < 1e-16:
            break
    # Deflate: cubic (y - gamma^2)(y^2 + p y + q).
    half_p = 0.5 * (square / cubic + gamma_squared)
    q = -1.0 / (cubic * gamma_squared)
    discriminant = half_p * half_p - q
    root = cmath.sqrt(discriminant)
    first = -half_p + root
    second = q / first if discriminant >= 0.0 else first.conjugate()
    return gamma_squared, first, second


def step_displacement(x: FloatArray, constants: PointLoad) -> FloatArray:
    """Return S(x), the point load's displacement over its final value.

    Parameters
    ----------
    x : ndarray
        t v_s/r, any shape.
    constants : PointLoad
        From `point_load`.

    Returns
    -------
    ndarray
        S, same shape; -inf at x = gamma, where the Rayleigh wave arrives.
    """
    x = np.asarray(x, dtype=np.float64)
    a, gamma = constants.slowness_p, constants.slowness_rayleigh
    s = np.where(x >= gamma, 1.0, 0.0)
    early, late = (x >= a) & (x < 1.0), (x >= 1.0) & (x < gamma)
    y = x[early]
    body = sum(
        (root.amplitude / np.sqrt(y * y - root.kappa_squared)).real for root in constants.body_roots
    )
    rayleigh = constants.rayleigh_amplitude / np.sqrt(gamma * gamma - y * y)
    s[early] = 0.5 * (1.0 - rayleigh - body)
    s[late] = 1.0 - constants.rayleigh_amplitude / np.sqrt(gamma * gamma - x[late] ** 2)
    return s
