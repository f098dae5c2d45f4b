# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Vertical surface displacement under a harmonic point load: the Fourier transform of Pekeris.

For a force exp(+i omega t) the surface at the distance r settles by (1 - nu)/(2 pi G r) S^(y) with
y = omega r/v_s and S^(y) = i y int_0^inf S(x) exp(-i y x) dx; S^(0) = 1. A load spread over an area is a
sum of point loads: see `circular` for the disc.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from roller_sim_ros.half_space.point_load import ComplexArray, FloatArray, PointLoad
from roller_sim_ros.half_space.quadrature import gauss_legendre

_CHUNK = 200_000  # exponentials at a time


def _transient_rule(load: PointLoad, count: int) -> tuple[FloatArray, ComplexArray]:
    """Nodes x and weights c such that int S exp(-i y x) dx - (steps) = sum c exp(-i y x).

    The substitutions x = gamma cos(phi) and x = kappa + v^2 remove the singularities of the Rayleigh
    and of the body-wave terms.
    """
    a, gamma = load.slowness_p, load.slowness_rayleigh
    unit, weight = gauss_legendre(count)
    at_p, at_s = math.acos(a / gamma), math.acos(1.0 / gamma)
    nodes = [gamma * np.cos(at_s * unit), gamma * np.cos(at_s + (at_p - at_s) * unit)]
    weights = [
        -load.rayleigh_amplitude * at_s * weight,
        -0.5 * load.rayleigh_amplitude * (at_p - at_s) * weight,
    ]
    for root in load.body_roots:
        kappa = cmath.sqrt(root.kappa_squared)
        origin = min(kappa.real, a)
        first, last = math.sqrt(a - origin), math.sqrt(1.0 - origin)
        v = first + (last - first) * unit
        x = origin + v * v
        strength = root.amplitude * 2.0 * v / np.sqrt(x * x - root.kappa_squared)
        nodes.append(x)
        weights.append(-0.5 * (last - first) * weight * strength.real)
    return np.concatenate(nodes), np.concatenate(weights)


def harmonic_displacement(y: FloatArray | ComplexArray, load: PointLoad) -> ComplexArray:
    """Return S^(y), the harmonic displacement of the surface over the static one.

    Parameters
    ----------
    y : ndarray, any shape
        omega r/v_s, real and not negative, or complex with a negative imaginary part (damping).
    load : PointLoad
        From `point_load.point_load`.

    Returns
    -------
    ndarray of complex
        Same shape; exp(+i omega t).
    """
    flat = np.asarray(y).ravel()
    a, gamma = load.slowness_p, load.slowness_rayleigh
    highest = float(np.abs(flat).max(initial=0.0))
    nodes, weights = _transient_rule(load, 40 + math.ceil(0.5 * highest * (gamma - a)))
    out = 0.5 * (np.exp(-1j * flat * a) + np.exp(-1j * flat))
    rows = max(1, _CHUNK // nodes.size)
    for start in range(0, flat.size, rows):
        part = flat[start : start + rows]
        out[start : start + rows] += 1j * part * (np.exp(-1j * np.outer(part, nodes)) @ weights)
    return np.asarray(out.reshape(np.shape(y)), dtype=np.complex128)
