# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How the exciter's force divides into vertical and horizontal, one entry per kind of exciter."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Direction:
    """Shares of F_e: vertical = F_e · vertical_sine · sin φ, horizontal = F_e (… sin φ + … cos φ).

    z up, x forward.
    """

    vertical_sine: float
    horizontal_sine: float
    horizontal_cosine: float


def circular(tilt_rad: float) -> Direction:
    """One rotating eccentric: the force turns with it (paper, eqs 11 and 12)."""
    del tilt_rad
    return Direction(1.0, 0.0, 1.0)


def directed(tilt_rad: float) -> Direction:
    """Two counter-rotating masses: force along one line, tilted from the vertical."""
    return Direction(math.cos(tilt_rad), math.sin(tilt_rad), 0.0)


DIRECTIONS: dict[str, Callable[[float], Direction]] = {
    "circular": circular,
    "directed": directed,
}
