# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Loops over samples that numpy cannot do; compiled."""

from functools import cache

import numpy as np

from roller_sim_ros.sensors.kernels.interpolation import HALF_WIDTH, interpolate
from roller_sim_ros.sensors.kernels.recursion import recurse_one, recurse_two

__all__ = ["HALF_WIDTH", "interpolate", "recurse_one", "recurse_two", "warm_up"]


@cache
def warm_up() -> None:
    """Compile the loops, so that the first block of a run is not late."""
    out = np.empty(1)
    recurse_one(0.0, np.zeros(1), np.zeros(1), out)
    recurse_two(np.eye(2), np.zeros((2, 1)), np.zeros(2), out)
    interpolate(np.zeros(2 * HALF_WIDTH), HALF_WIDTH, np.zeros(1), out)
