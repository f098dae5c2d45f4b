# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Compaction that slows down early and goes on for long."""

from __future__ import annotations

from dataclasses import dataclass

from roller_sim_ros.site.compaction.law import ASSUMED, Array, CompactionLaw
from roller_sim_ros.site.declaration import declare


@dataclass(frozen=True)
class Hyperbolic(CompactionLaw):
    """r = 1/(1 + n/N): half of the way in N passes, nine tenths in 9 N."""

    passes: float = declare(
        "passes that take half of the way to the limits (N)",
        default=2.0,
        minimum=0.1,
        maximum=1000.0,
        source=ASSUMED,
    )

    def remaining(self, passes: Array) -> Array:
        """Return 1/(1 + n/N)."""
        return 1.0 / (1.0 + passes / self.passes)
