# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Gauss quadrature on the unit interval."""

from __future__ import annotations

import functools

import numpy as np

from roller_sim_ros.half_space.point_load import FloatArray


@functools.lru_cache(maxsize=256)
def gauss_legendre(count: int) -> tuple[FloatArray, FloatArray]:
    """Return nodes and weights of the Gauss rule with `count` points on [0, 1]."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 * (nodes + 1.0), 0.5 * weights
