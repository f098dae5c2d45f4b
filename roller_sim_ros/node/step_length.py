# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How far one request may step: the roller refuses more, and so does a client that asks for it piece by piece."""

from __future__ import annotations

import math

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

MOST_S = 3600.0
"""Simulated time of one request at most: nobody else is heard meanwhile."""
MOST_HZ = 80.0
"""Greatest excitation frequency, by which steps are reckoned as time."""


def check_samples(samples: int) -> None:
    """Refuse a step of so many samples if it is none, or too long.

    Raises
    ------
    RollerSimError
        Then.
    """
    most = int(MOST_S * MOST_HZ * SAMPLES_PER_REVOLUTION)
    if not 1 <= samples <= most:
        raise RollerSimError(f"steps {samples}: must be 1 … {most} samples at a time")


def check_advance(revolutions: int, seconds: float) -> None:
    """Refuse a step by both or by neither, or one that is too long.

    Raises
    ------
    RollerSimError
        Then.
    """
    most = int(MOST_S * MOST_HZ)
    if not math.isfinite(seconds) or not 0.0 <= seconds <= MOST_S:
        raise RollerSimError(f"seconds {seconds}: must be 0 … {MOST_S:g} s at a time")
    if (revolutions > 0) == (seconds > 0.0):
        raise RollerSimError(
            f"revolutions {revolutions}, seconds {seconds:g}: one of them must be 0, the other not"
        )
    if revolutions > most:
        raise RollerSimError(f"revolutions {revolutions}: must be at most {most} at a time")
