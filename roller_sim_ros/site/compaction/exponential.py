# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Compaction that goes the same share of what is left with each pass."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roller_sim_ros.site.compaction.law import ASSUMED, Array, CompactionLaw
from roller_sim_ros.site.declaration import declare


@dataclass(frozen=True)
class Exponential(CompactionLaw):
    """r = exp(−n/N): refusal comes after a few N."""

    passes: float = declare(
        "passes that take 63 % of the way to the limits (N)",
        default=3.0,
        minimum=0.1,
        maximum=1000.0,
        source=f"{ASSUMED}: 4 to 8 passes are usual to a specified density",
    )

    def remaining(self, passes: Array) -> Array:
        """Return exp(−n/N)."""
        return np.exp(-passes / self.passes)
