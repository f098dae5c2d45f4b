# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The transient of `roller_sim_ros.half_space.transient` at some times; compiled.

One wave at a time: u = r^2 is how far it has come, t^2 = u - c^2 and psi belong to a side at the distance c. A term
1/w of S, w^2 = beta + lambda u, comes with phi, of which d phi/du = -tau/(2 u w), and with the edge's w, that at
max(u, c^2), the part of the range in which t is not zero. Real terms and those of a complex root go through the same
lines.
"""

from __future__ import annotations

import cmath
import math
from typing import Any

from roller_sim_ros.half_space.point_load import ComplexArray, FloatArray
from roller_sim_ros.jit import njit

_LEAST_LOGARITHM = 1e-300

Side = tuple[float, float, float, float, float]
"""c, b, sigma, mu and scale of a pair of sides, as in `roller_sim_ros.half_space.rectangle`."""


@njit
def _tangent(c: float, u: float) -> float:
    return math.sqrt(max(u - c * c, 0.0))


@njit
def _angle(c: float, sigma: float, t: float) -> float:
    angle = math.atan2(t, c)
    return angle if sigma > 0.0 else 0.5 * math.pi - angle


@njit
def _weight_integrals(side: Side, u: float) -> tuple[float, float]:
    """Return int_0^r m dr and int_0^r m r dr of a pair of sides."""
    c, b, sigma, mu, scale = side
    r, t = math.sqrt(u), _tangent(c, u)
    psi, g = _angle(c, sigma, t), math.asinh(t / c)
    along = psi * r * (1.0 - u / (6.0 * b * b)) + 0.5 * mu * (r * t - c * c * g)
    along -= sigma * c * (g - (r * t + c * c * g) / (12.0 * b * b))
    n = t * (2.0 - (c * c / 3.0 + u / 6.0) / (b * b))
    area = psi * u * (1.0 - u / (4.0 * b * b)) - 0.5 * sigma * c * n + 2.0 / 3.0 * mu * t * t * t
    return scale * along, 0.5 * scale * area


@njit
def _of_parabola(
    side: Side, u: float, psi: float, term: Any, i1: Any, i2: Any, curvature: float
) -> Any:
    """Antiderivative of psi (1 - 3 curvature u)/(2 w), by parts on the polynomial."""
    lam, beta, w = term
    q = 1.0 + 2.0 * curvature * beta / lam
    by_parts = 0.5 * side[2] * side[0] * (q * i1 - curvature * i2)
    return (psi * w * (q - curvature * u) - by_parts) / lam


@njit
def _antiderivatives(
    side: Side, u: float, tau: float, term: Any, phi: Any, edge_w: Any, big_t: Any, big_e: Any
) -> Any:
    """Antiderivatives in u of m/(2w), for the step, and of m phi/2, for the ramp.

    Constants of integration do not depend on u.

    Parameters
    ----------
    side
        The pair of sides.
    u, tau
        How far the wave has come, squared, and the time.
    term
        lambda, beta and w at u.
    phi, edge_w, big_t, big_e
        As in the module's text; T = int dt/w and E = int dt/((c^2 + t^2) w) up to constants.
    """
    c, b, sigma, mu, scale = side
    lam, beta, _ = term
    t = _tangent(c, u)
    psi = _angle(c, sigma, t)
    d_t = (beta + lam * c * c) * big_t
    i1 = 2.0 * (lam * big_t + beta * big_e)  # int w/(u t) du
    i2 = t * edge_w + d_t  # int w/t du
    i3 = (t * edge_w - d_t) / lam  # int t/w du
    i4 = 2.0 * (big_t - c * c * big_e)  # int t/(u w) du
    curvature = 1.0 / (6.0 * b * b)
    step = _of_parabola(side, u, psi, term, i1, i2, curvature) + 0.5 * mu * i3
    n0 = 2.0 - c * c / (3.0 * b * b)
    ramp = psi * u * (1.0 - 1.5 * curvature * u) * phi
    ramp += tau * _of_parabola(side, u, psi, term, i1, i2, 0.5 * curvature)
    ramp -= 0.5 * sigma * c * t * (n0 - curvature * u) * phi
    ramp -= 0.25 * sigma * c * tau * (n0 * i4 - curvature * i3)
    ramp += mu * (2.0 / 3.0 * t * t * t * phi + tau / 3.0 * (i3 - c * c * i4))
    return scale * step, 0.5 * scale * ramp


@njit
def _rayleigh(
    side: Side, u: float, tau: float, gamma: float, at_front: bool
) -> tuple[float, float]:
    """Antiderivatives with the term 1/sqrt(gamma^2 u - tau^2)."""
    c, slope = side[0], gamma * gamma
    t, edge_u = _tangent(c, u), max(u, c * c)
    # At the wave's own front the difference leaves 1e-8 of rounding where there is exactly nothing.
    w = 0.0 if at_front else math.sqrt(max(slope * u - tau * tau, 0.0))
    edge_w = w if u > c * c else math.sqrt(max(slope * c * c - tau * tau, 0.0))
    big_t = math.log(max(gamma * t + edge_w, _LEAST_LOGARITHM)) / gamma
    big_e = math.log(max(c * edge_w + tau * t, _LEAST_LOGARITHM)) - 0.5 * math.log(edge_u)
    term = (slope, -tau * tau, w)
    phi = math.atan2(tau, w)
    found: tuple[float, float] = _antiderivatives(
        side, u, tau, term, phi, edge_w, big_t, big_e / (c * tau)
    )
    return found


@njit
def _body(side: Side, u: float, tau: float, kappa_squared: float) -> tuple[float, float]:
    """Antiderivatives with the term 1/sqrt(tau^2 - kappa^2 u) of a real root."""
    c, t = side[0], _tangent(side[0], u)
    # At the shear front a root kappa next to 1, Poisson's ratio next to 0, leaves a rounding error below nothing.
    w = math.sqrt(max(tau * tau - kappa_squared * u, 0.0))
    phi = math.log((tau + w) / math.sqrt(u))
    edge_w = w if u > c * c else 0.0  # t = 0 there: no contribution
    kappa = math.sqrt(kappa_squared)
    big_t = math.atan2(kappa * t, edge_w) / kappa
    big_e = math.atan2(tau * t, c * edge_w) / (c * tau)
    term = (-kappa_squared, tau * tau, w)
    found: tuple[float, float] = _antiderivatives(side, u, tau, term, phi, edge_w, big_t, big_e)
    return found


@njit
def _body_pair(side: Side, u: float, tau: float, kappa_squared: complex) -> tuple[complex, complex]:
    """As `_body`, of the root that stands for a complex pair."""
    c, t, slope = side[0], _tangent(side[0], u), -kappa_squared
    w = cmath.sqrt(tau * tau + slope * u)
    phi = cmath.log((tau + w) / math.sqrt(u))
    # w and the root of lambda lie in one quadrant: no logarithm crosses its cut.
    edge_w = w if u > c * c else cmath.sqrt(tau * tau + slope * c * c)
    root = cmath.sqrt(slope)
    big_t = cmath.log(root * t + edge_w) / root
    big_e = cmath.atan(tau * t / (c * edge_w)) / (c * tau)
    term = (slope, complex(tau * tau), w)
    found: tuple[complex, complex] = _antiderivatives(side, u, tau, term, phi, edge_w, big_t, big_e)
    return found


@njit
def _body_between(
    side: Side, u_s: float, u_p: float, tau: float, kappa_squared: complex, amplitude: complex
) -> tuple[float, float]:
    """What a body root adds to twice step and ramp, between the S and the P wave."""
    if kappa_squared.imag != 0.0:
        step_s, ramp_s = _body_pair(side, u_s, tau, kappa_squared)
        step_p, ramp_p = _body_pair(side, u_p, tau, kappa_squared)
        return (amplitude * (step_p - step_s)).real, (amplitude * (ramp_p - ramp_s)).real
    before = _body(side, u_s, tau, kappa_squared.real)
    after = _body(side, u_p, tau, kappa_squared.real)
    return amplitude.real * (after[0] - before[0]), amplitude.real * (after[1] - before[1])


@njit
def fill(
    tau: FloatArray,
    load: tuple[float, float, float],
    fronts: tuple[float, float, float],
    size: tuple[float, float, float],
    both_sides: tuple[Side, Side],
    roots: ComplexArray,
    step: FloatArray,
    ramp: FloatArray,
) -> None:
    """Fill in step response and ramp.

    Parameters
    ----------
    tau : ndarray, shape (n,)
        Dimensionless times.
    load : tuple
        a, gamma and A of the point load.
    fronts : tuple
        What its ramp has gained when P, S and Rayleigh wave have come.
    size : tuple
        Square of the corner's distance, int m dr up to there, and the memory.
    both_sides : tuple
        Both pairs of sides.
    roots : ndarray of complex, shape (roots, 2)
        kappa_j^2 and A_j of the body waves.
    step, ramp : ndarray, shape (n,)
        Receive s and R.
    """
    a, gamma, strength = load
    after_p, after_s, after_rayleigh = fronts
    farthest, whole, memory = size
    for i in range(tau.shape[0]):
        time = tau[i]
        if time >= memory:
            # Both are known there without the rounding of large terms that cancel.
            step[i] = 1.0
            ramp[i] = time + after_rayleigh / whole
            continue
        if not time > 0.0:
            step[i] = ramp[i] = 0.0
            continue
        r_r, r_p = time / gamma, time / a
        u_r = min(r_r * r_r, farthest)
        u_s = min(time * time, farthest)
        u_p = min(r_p * r_p, farthest)
        s, r = 0.0, 0.0
        for side in both_sides:
            along_s, area_s = _weight_integrals(side, u_s)
            along_p, area_p = _weight_integrals(side, u_p)
            area_r = _weight_integrals(side, u_r)[1]
            s += 0.5 * (along_s + along_p)
            r += 0.5 * time * (along_s + along_p) + after_p * (area_p - area_s)
            r += after_rayleigh * area_r + after_s * (area_s - area_r)
            step_r, ramp_r = _rayleigh(side, u_r, time, gamma, True)
            step_s, ramp_s = _rayleigh(side, u_s, time, gamma, False)
            step_p, ramp_p = _rayleigh(side, u_p, time, gamma, False)
            s -= strength * (0.5 * step_s - step_r + 0.5 * step_p)
            r -= strength * (0.5 * ramp_s - ramp_r + 0.5 * ramp_p)
            if u_s < u_p:
                for n in range(roots.shape[0]):
                    add_s, add_r = _body_between(side, u_s, u_p, time, roots[n, 0], roots[n, 1])
                    s -= 0.5 * add_s
                    r -= 0.5 * add_r
        step[i] = s / whole
        ramp[i] = r / whole
