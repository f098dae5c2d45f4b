# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A rigid cylinder pressed on an elastic half space along a line of finite length (Lundberg 1939).

    z = (1 − ν²)/E · F/L · (2/π) (1.8864 + ln(L/b)),    b² = (16/π) · R (1 − ν²)/E · F/L

with F the force, z the cylinder's approach, R its radius, L its length, b the width of the contact. As commonly
cited for E_vib (Kröber 2001), not verified in the original. An infinitely long cylinder would have no finite z.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from roller_sim_ros.meters import kernels
from roller_sim_ros.meters.kernels.line_contact import CONSTANT

_modulus = np.vectorize(kernels.modulus, otypes=[np.float64])


def approach(
    force_n: npt.ArrayLike,
    modulus_pa: npt.ArrayLike,
    radius_m: npt.ArrayLike,
    length_m: npt.ArrayLike,
    poisson_ratio: float,
) -> NDArray[np.float64]:
    """Return z under a force, m.

    Parameters
    ----------
    force_n : array_like
        F, positive.
    modulus_pa : array_like
        E, Young's modulus.
    radius_m, length_m : array_like
        R and L.
    poisson_ratio : float
        ν.
    """
    force, length = np.asarray(force_n), np.asarray(length_m)
    compliance = (1.0 - poisson_ratio**2) / np.asarray(modulus_pa)
    width = np.sqrt(16.0 / math.pi * np.asarray(radius_m) * compliance * force / length)
    return np.asarray(
        compliance * force / length * (2.0 / math.pi) * (CONSTANT + np.log(length / width))
    )


def modulus(
    slope_m_n: npt.ArrayLike,
    force_log_slope: npt.ArrayLike,
    radius_m: npt.ArrayLike,
    length_m: npt.ArrayLike,
    poisson_ratio: float,
) -> NDArray[np.float64]:
    """Return the E whose `approach` has a slope between some forces, Pa.

    z is c F (a + ½ ln E − ½ ln F) / E with constants a and c. Whatever linear measure of slope is taken of the
    points (a secant, a regression), it is 1 for F itself; if it is s for F ln F, z has the slope
    c (a + ½ ln E − ½ s) / E. With x for the bracket that is x − ½ ln x = d, solved by Newton's rule from above: of
    the two solutions that is the physical one, x > ½, where z rises with the force.

    Parameters
    ----------
    slope_m_n : array_like
        Slope of z over F, m/N.
    force_log_slope : array_like
        s, the same measure of F ln F over F, forces in N.
    radius_m, length_m : array_like
        R and L.
    poisson_ratio : float
        ν.

    Returns
    -------
    ndarray
        E, Pa; NaN where no E has that slope (it is not positive, or the contact would be wider than the
        cylinder is long).
    """
    return np.asarray(
        _modulus(slope_m_n, force_log_slope, radius_m, length_m, poisson_ratio), dtype=np.float64
    )
