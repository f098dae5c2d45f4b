# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""From a dimensionless compliance to one over real frequencies, with hysteretic damping."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from roller_sim_ros.half_space.checks import HalfSpaceError
from roller_sim_ros.half_space.point_load import ComplexArray


def over_frequency(
    compliance: Callable[[npt.NDArray[Any]], ComplexArray],
    omega: npt.ArrayLike,
    unit_time_s: float,
    hysteretic_damping: float,
) -> ComplexArray:
    """Evaluate a dimensionless compliance at real frequencies of either sign.

    Parameters
    ----------
    compliance : callable
        Of a0 = omega * unit time, not negative or with a negative imaginary part; inversely proportional
        to the shear modulus.
    omega : array_like, any shape
        Angular frequency, rad/s.
    unit_time_s : float
        Length over shear wave speed, s.
    hysteretic_damping : float
        Damping ratio xi of the complex shear modulus G (1 + 2 i xi sgn omega), not negative.

    Returns
    -------
    ndarray of complex, same shape as `omega`

    Notes
    -----
    The correspondence principle: G becomes complex wherever it stands, Poisson's ratio stays real. The
    static value of a damped half space is complex (its hysteresis does not depend on the rate); at
    omega = 0 itself it is the real one.
    """
    if not (math.isfinite(hysteretic_damping) and hysteretic_damping >= 0.0):
        raise HalfSpaceError(f"hysteretic_damping = {hysteretic_damping!r} must not be negative")
    angular = np.asarray(omega, dtype=np.float64)
    if not np.all(np.isfinite(angular)):
        raise HalfSpaceError("omega must be finite")
    a0 = np.abs(angular) * unit_time_s
    if hysteretic_damping == 0.0:
        h = compliance(a0)
    else:
        modulus = complex(1.0, 2.0 * hysteretic_damping)
        h = compliance(a0 / np.sqrt(modulus)) / np.where(angular == 0.0, 1.0, modulus)
    return np.asarray(np.where(angular < 0.0, np.conj(h), h))
