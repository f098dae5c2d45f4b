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

CONSTANT = 1.8864

_ROUNDS = 6
"""Newton's rounds, of which five suffice from 1 kPa to 10 GPa."""


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
    slope, length = np.asarray(slope_m_n, dtype=np.float64), np.asarray(length_m)
    plane = 1.0 - poisson_ratio**2
    scale = 2.0 / math.pi * plane / length
    width = 16.0 / math.pi * np.asarray(radius_m) * plane / length
    rest = CONSTANT + np.log(length) - 0.5 * np.log(width) - 0.5 * np.asarray(force_log_slope)
    with np.errstate(invalid="ignore", divide="ignore"):
        level = rest + 0.5 * np.log(scale / slope)
        bracket = level + 0.5 * np.log(2.0 * np.maximum(level, 1.0))
        for _ in range(_ROUNDS):
            bracket -= (bracket - 0.5 * np.log(bracket) - level) / (1.0 - 0.5 / bracket)
        found = scale * bracket / slope
    # The least that x − ½ ln x can be is what it is at ½.
    return np.where((slope > 0.0) & (level > 0.5 - 0.5 * math.log(0.5)), found, np.nan)
