# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Coarse map: how badly each ground of a grid explains force and depth of a motion, and the best one from there.

For a ground (G, p) what is left of the depth in contact, depth − e(force; G, p) − p Σ ΔF⁺/F_stat less datum and
sinking, should be nothing. That needs no run of the model, so it asks for no initial state and knows no attractors; a
grid of 2400 grounds takes some hundredths of a second.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from roller_sim_ros.estimate.inversion import Inverted
from roller_sim_ros.estimate.surfaces import LEAST, MOST, SURFACES
from roller_sim_ros.parameters import Configuration

Array = NDArray[np.float64]

MODULI = 60
PLASTICS = 40
"""Numbers of G and of p in the map, evenly spaced in their logarithms."""

_MODULI = np.geomspace(5e6, 400e6, MODULI)
_PLASTICS = np.geomspace(5e-5, 5e-3, PLASTICS)


def unexplained(
    moduli: Array, plastic: float, inverted: Inverted, period: int, known: Configuration
) -> Array:
    """Return what of the depth in contact some grounds leave unexplained, m, shape (grounds, samples in contact).

    Parameters
    ----------
    moduli : ndarray, shape (grounds,)
        G, Pa.
    plastic : float
        p, m.
    inverted : Inverted
        Force and depth.
    period : int
        Revolutions in them.
    known : Configuration
        Machine, exciter, half space, density, Poisson's ratio.
    """
    count = len(inverted.force)
    surface = SURFACES[known.half_space.model](moduli, plastic, known, count, period)
    elastic = np.fft.irfft(surface * np.fft.rfft(inverted.force), count, axis=1)
    compliance = plastic / known.machine.static_load_n
    left = inverted.depth[inverted.contact] - elastic[:, inverted.contact]
    left -= compliance * inverted.loaded
    return np.asarray(left - (left @ inverted.basis) @ inverted.basis.T)


def soil_map(inverted: Inverted, period: int, known: Configuration) -> tuple[Array, Array, Array]:
    """Return G, Pa, p, m, and the mean square of what is left unexplained, m², shape (p, G), on the grid."""
    left = [
        np.mean(unexplained(_MODULI, float(plastic), inverted, period, known) ** 2, axis=1)
        for plastic in _PLASTICS
    ]
    return _MODULI, _PLASTICS, np.array(left)


def best_ground(inverted: Inverted, period: int, known: Configuration) -> Array:
    """Return ln G and ln p of the ground that explains a motion best: from the map, then by least squares.

    Parameters
    ----------
    inverted, period, known
        As for `unexplained`.
    """
    moduli, plastics, left = soil_map(inverted, period, known)
    row, column = np.unravel_index(int(left.argmin()), left.shape)
    start = np.log([moduli[column], plastics[row]])
    scale = float(np.sqrt(left.min())) + 1e-12

    def residual(logs: Array) -> Array:
        modulus, plastic = np.exp(logs)
        ground = unexplained(np.array([modulus]), float(plastic), inverted, period, known)
        return np.asarray(ground[0] / scale)

    found = least_squares(
        residual,
        start,
        bounds=(np.log(LEAST), np.log(MOST)),
        diff_step=[1e-4, 1e-4],
        xtol=1e-4,
        max_nfev=15,
    )
    return np.asarray(found.x)
