"""Exact transient of the rectangle's centre, in closed form: the step response and its ramp.

Lengths are in units of sqrt(BL), times in units of sqrt(BL)/v_s. With the point load's S(x)
(`point_load`) and the load's weight m(r) at the distance r from the centre (`rectangle`),

    s(tau) = int m(r) S(tau/r) dr / int m(r) dr,        R(tau) = int_0^tau s.

m is a sum over the sides of psi P + mu t; S is made of terms 1/sqrt(lambda r^2 + beta). With u = r^2,
every product of the two integrates, by parts on P, to

    T = int dt/w,        E = int dt/((c^2 + t^2) w),        w^2 = beta + lambda u,

which are logarithms and arc tangents. No quadrature is left.

Pekeris (1955) and Mooney (1974) for S; the integration over the rectangle is this package's.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from roller_sim_ros.half_space.point_load import (
    FloatArray,
    PointLoad,
    point_load,
)
from roller_sim_ros.half_space.rectangle import Side, sides, static_weight

NumberArray: TypeAlias = npt.NDArray[Any]  # real, or complex for a complex root

_LEAST_LOGARITHM = 1e-300


@dataclass(frozen=True)
class _Term:
    """One term 1/w of S at some upper limit u: w^2 = beta + lambda u and what integrates with it.

    Attributes
    ----------
    slope : float or complex
        lambda.
    beta : ndarray
        -tau^2 for the Rayleigh wave's term, tau^2 for the body waves'.
    w : ndarray
        At u.
    phi : ndarray
        With d phi/du = -tau/(2 u w).
    edge_w : ndarray
        w at max(u, c^2), the part of the range in which t is not zero.
    big_t, big_e : ndarray
        T and E there, up to constants.
    """

    slope: complex
    beta: NumberArray
    w: NumberArray
    phi: NumberArray
    edge_w: NumberArray
    big_t: NumberArray
    big_e: NumberArray


def _rayleigh_term(side: Side, u: FloatArray, tau: FloatArray, gamma: float) -> _Term:
    """Term 1/sqrt(gamma^2 u - tau^2); the first row of `u` is its own front (tau/gamma)^2."""
    c, slope = side.distance, gamma * gamma
    edge_u, t = np.maximum(u, c * c), side.tangent(u)
    w = np.sqrt(np.maximum(slope * u - tau * tau, 0.0))
    w[0] = 0.0  # the difference leaves 1e-8 of rounding where there is exactly nothing
    before_edge = np.sqrt(np.maximum(slope * c * c - tau * tau, 0.0))
    edge_w = np.where(u > c * c, w, before_edge)
    big_t = np.log(np.maximum(gamma * t + edge_w, _LEAST_LOGARITHM)) / gamma
    big_e = np.log(np.maximum(c * edge_w + tau * t, _LEAST_LOGARITHM)) - 0.5 * np.log(edge_u)
    return _Term(slope, -tau * tau, w, np.arctan2(tau, w), edge_w, big_t, big_e / (c * tau))


def _body_term(side: Side, u: FloatArray, tau: FloatArray, kappa_squared: complex) -> _Term:
    """Term 1/sqrt(tau^2 - kappa^2 u), real or complex."""
    c, t = side.distance, side.tangent(u)
    slope = -kappa_squared if kappa_squared.imag else -kappa_squared.real
    w_squared = tau * tau + slope * u
    if not isinstance(slope, complex):
        # At the shear front a root kappa next to 1, Poisson's ratio next to 0, leaves a rounding error below nothing.
        w_squared = np.maximum(w_squared, 0.0)
    w = np.sqrt(w_squared)
    phi = np.log((tau + w) / np.sqrt(u))
    if isinstance(slope, complex):
        # w and the root of lambda lie in one quadrant: no logarithm crosses its cut.
        edge_w = np.where(u > c * c, w, np.sqrt(tau * tau + slope * c * c))
        root = cmath.sqrt(slope)
        big_t = np.log(root * t + edge_w) / root
        big_e = np.arctan(tau * t / (c * edge_w)) / (c * tau)
    else:
        edge_w = np.where(u > c * c, w, 0.0)  # t = 0 there: no contribution
        kappa = math.sqrt(-slope)
        big_t = np.arctan2(kappa * t, edge_w) / kappa
        big_e = np.arctan2(tau * t, c * edge_w) / (c * tau)
    return _Term(slope, tau * tau, w, phi, edge_w, big_t, big_e)


def _antiderivatives(
    side: Side, u: FloatArray, tau: FloatArray, term: _Term
) -> tuple[NumberArray, NumberArray]:
    """Antiderivatives in u of m/(2w), for the step, and of m phi/2, for the ramp.

    Constants of integration do not depend on u.
    """
    c, b, sigma, mu = side.distance, side.half_width, side.sense, side.edge
    lam, beta, w, phi = term.slope, term.beta, term.w, term.phi
    t = side.tangent(u)
    psi = side.angle(t)
    d_t = (beta + lam * c * c) * term.big_t
    i1 = 2.0 * (lam * term.big_t + beta * term.big_e)  # int w/(u t) du
    i2 = t * term.edge_w + d_t  # int w/t du
    i3 = (t * term.edge_w - d_t) / lam  # int t/w du
    i4 = 2.0 * (term.big_t - c * c * term.big_e)  # int t/(u w) du
    curvature = 1.0 / (6.0 * b * b)

    def of_parabola(p: float) -> NumberArray:
        # int psi (1 - 3 p u)/(2 w) du, by parts on the polynomial
        q = 1.0 + 2.0 * p * beta / lam
        out: NumberArray = (psi * w * (q - p * u) - 0.5 * sigma * c * (q * i1 - p * i2)) / lam
        return out

    step = of_parabola(curvature) + 0.5 * mu * i3
    n0 = 2.0 - c * c / (3.0 * b * b)
    ramp: NumberArray = psi * u * (1.0 - 1.5 * curvature * u) * phi
    ramp = ramp + tau * of_parabola(0.5 * curvature)
    ramp -= 0.5 * sigma * c * t * (n0 - curvature * u) * phi
    ramp -= 0.25 * sigma * c * tau * (n0 * i4 - curvature * i3)
    ramp += mu * (2.0 / 3.0 * t**3 * phi + tau / 3.0 * (i3 - c * c * i4))
    return side.scale * step, 0.5 * side.scale * ramp


@dataclass(frozen=True)
class _PointRamp:
    """Values of int_0^x S at the wave fronts that the ramp needs."""

    after_p: float  # added to x - a in a < x < 1, before the functions of x
    after_s: float
    after_rayleigh: float

    @classmethod
    def of(cls, load: PointLoad) -> _PointRamp:
        a, gamma, strength = load.slowness_p, load.slowness_rayleigh, load.rayleigh_amplitude

        def body(x: float) -> float:
            total = 0.0
            for root in load.body_roots:
                phi = cmath.log(x + cmath.sqrt(x * x - root.kappa_squared))
                total += (root.amplitude * phi).real
            return total

        at_p, at_s = strength * math.asin(a / gamma), strength * math.asin(1.0 / gamma)
        ramp_s = 0.5 * ((1.0 - a) - (at_s - at_p) - (body(1.0) - body(a)))
        ramp_rayleigh = ramp_s + gamma - 1.0 - (0.5 * math.pi * strength - at_s)
        return cls(
            after_p=0.5 * (-a + at_p + body(a)),
            after_s=ramp_s - 1.0 + at_s,
            after_rayleigh=ramp_rayleigh - gamma,
        )


def memory(aspect_ratio: float, poisson_ratio: float) -> float:
    """Return T v_s/sqrt(BL): from here on the response to a step is exactly its static value."""
    diagonal = math.sqrt(aspect_ratio + 1.0 / aspect_ratio)
    return point_load(poisson_ratio).slowness_rayleigh * diagonal


def initial_velocity(aspect_ratio: float, poisson_ratio: float) -> float:
    """Return ds/dtau at tau = 0+: the centre starts as a plane P wave does, stress/(rho v_p)."""
    load = point_load(poisson_ratio)
    centre = 0.75 * math.pi  # m(0), 2 pi times the stress in the centre
    return centre * load.slowness_p / ((1.0 - poisson_ratio) * static_weight(aspect_ratio))


def wave_fronts(aspect_ratio: float, poisson_ratio: float) -> list[float]:
    """Times, in units of sqrt(BL)/v_s, at which the step response is not smooth, in rising order.

    P, S and Rayleigh waves arrive from the two pairs of sides and from the corners.
    """
    load = point_load(poisson_ratio)
    distances = (aspect_ratio**-0.5, aspect_ratio**0.5, math.sqrt(aspect_ratio + 1 / aspect_ratio))
    slownesses = (load.slowness_p, 1.0, load.slowness_rayleigh)
    return sorted({slowness * distance for slowness in slownesses for distance in distances})


def step_and_ramp(
    tau: FloatArray, aspect_ratio: float, poisson_ratio: float
) -> tuple[FloatArray, FloatArray]:
    """Exact normalised step response s and its integral R at the centre of the rectangle.

    Parameters
    ----------
    tau : ndarray, shape (n,)
        Dimensionless times t v_s/sqrt(BL), none negative.
    aspect_ratio : float
        alpha = L/B.
    poisson_ratio : float
        nu, 0 <= nu < 0.5.

    Returns
    -------
    step, ramp : ndarray, shape (n,)
        s, from 0 at tau = 0 to 1 at the memory and after, and R in units of sqrt(BL)/v_s.
    """
    load = point_load(poisson_ratio)
    farthest = aspect_ratio + 1.0 / aspect_ratio
    whole = static_weight(aspect_ratio)
    fronts = _PointRamp.of(load)
    tau = np.asarray(tau, dtype=np.float64)
    positive = tau > 0.0
    time = np.where(positive, tau, 1.0)
    a, gamma, strength = load.slowness_p, load.slowness_rayleigh, load.rayleigh_amplitude

    # Rows: the distances, squared, that the Rayleigh, the S and the P wave have come from.
    u = np.minimum((time / np.array([[gamma], [1.0], [a]])) ** 2, farthest)
    share = strength * np.array([[-1.0], [0.5], [0.5]])
    step, ramp = np.zeros_like(time), np.zeros_like(time)
    for side in sides(aspect_ratio):
        along, area = side.weight_integrals(u)
        step += 0.5 * (along[1] + along[2])
        ramp += 0.5 * time * (along[1] + along[2]) + fronts.after_p * (area[2] - area[1])
        ramp += fronts.after_rayleigh * area[0] + fronts.after_s * (area[1] - area[0])
        of_step, of_ramp = _antiderivatives(side, u, time, _rayleigh_term(side, u, time, gamma))
        step -= (share * of_step).sum(axis=0)
        ramp -= (share * of_ramp).sum(axis=0)
        for root in load.body_roots:
            term = _body_term(side, u[1:], time, root.kappa_squared)
            of_step, of_ramp = _antiderivatives(side, u[1:], time, term)
            step -= 0.5 * (root.amplitude * (of_step[1] - of_step[0])).real
            ramp -= 0.5 * (root.amplitude * (of_ramp[1] - of_ramp[0])).real
    # Outside the memory both are known without the rounding of large terms that cancel.
    late = tau >= memory(aspect_ratio, poisson_ratio)
    step = np.where(late, 1.0, np.where(positive, step / whole, 0.0))
    ramp = np.where(positive, ramp / whole, 0.0)
    return step, np.where(late, tau + fronts.after_rayleigh / whole, ramp)
