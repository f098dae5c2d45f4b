# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Lundberg's relation inverted, for one slope."""

from __future__ import annotations

import math

from roller_sim_ros.jit import njit

CONSTANT = 1.8864

_ROUNDS = 6
"""Newton's rounds, of which five suffice from 1 kPa to 10 GPa."""
_LEAST_LEVEL = 0.5 - 0.5 * math.log(0.5)
"""What x − ½ ln x is at ½, the least that it can be."""


@njit
def modulus(
    slope: float, force_log_slope: float, radius: float, length: float, poisson_ratio: float
) -> float:
    """As `roller_sim_ros.meters.lundberg.modulus`, for single numbers."""
    if not 0.0 < slope < math.inf:
        return math.nan
    plane = 1.0 - poisson_ratio * poisson_ratio
    scale = 2.0 / math.pi * plane / length
    width = 16.0 / math.pi * radius * plane / length
    rest = CONSTANT + math.log(length) - 0.5 * math.log(width) - 0.5 * force_log_slope
    level = rest + 0.5 * math.log(scale / slope)
    if not level > _LEAST_LEVEL:
        return math.nan
    bracket = level + 0.5 * math.log(2.0 * max(level, 1.0))
    for _ in range(_ROUNDS):
        bracket -= (bracket - 0.5 * math.log(bracket) - level) / (1.0 - 0.5 / bracket)
    return scale * bracket / slope
