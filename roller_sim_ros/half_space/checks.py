# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Checks of the arguments that every public function of the half space shares."""

from __future__ import annotations

import math

from roller_sim_ros.errors import RollerSimError


class HalfSpaceError(RollerSimError):
    """An argument for which the half space is not defined."""


def require_positive(**values: float) -> None:
    """Raise `HalfSpaceError` unless every named value is positive and finite."""
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0.0):
            raise HalfSpaceError(f"{name} = {value!r} must be positive and finite")


def require_poisson_ratio(poisson_ratio: float) -> None:
    """Raise `HalfSpaceError` unless 0 <= nu < 0.5, the range of the transient's closed form."""
    if not 0.0 <= poisson_ratio < 0.5:
        raise HalfSpaceError(f"poisson_ratio = {poisson_ratio!r} must be at least 0 and below 0.5")
