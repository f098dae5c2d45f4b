# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Exact transient of the rectangle's centre, in closed form: the step response and its ramp.

Lengths are in units of sqrt(BL), times in units of sqrt(BL)/v_s. With the point load's S(x)
(`point_load`) and the load's weight m(r) at the distance r from the centre (`rectangle`),

    s(tau) = int m(r) S(tau/r) dr / int m(r) dr,        R(tau) = int_0^tau s.

m is a sum over the sides of psi P + mu t; S is made of terms 1/sqrt(lambda r^2 + beta). With u = r^2,
every product of the two integrates, by parts on P, to

    T = int dt/w,        E = int dt/((c^2 + t^2) w),        w^2 = beta + lambda u,

which are logarithms and arc tangents. No quadrature is left; `transient_kernel` has the formulas.

Pekeris (1955) and Mooney (1974) for S; the integration over the rectangle is this package's.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from roller_sim_ros.half_space import transient_kernel
from roller_sim_ros.half_space.point_load import FloatArray, PointLoad, point_load
from roller_sim_ros.half_space.rectangle import sides, static_weight


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
    fronts = _PointRamp.of(load)
    across, along = sides(aspect_ratio)
    tau = np.ascontiguousarray(tau, dtype=np.float64)
    step, ramp = np.empty_like(tau), np.empty_like(tau)
    transient_kernel.fill(
        tau,
        (load.slowness_p, load.slowness_rayleigh, load.rayleigh_amplitude),
        (fronts.after_p, fronts.after_s, fronts.after_rayleigh),
        (
            aspect_ratio + 1.0 / aspect_ratio,
            static_weight(aspect_ratio),
            memory(aspect_ratio, poisson_ratio),
        ),
        (across.constants, along.constants),
        load.root_constants,
        step,
        ramp,
    )
    return step, ramp
