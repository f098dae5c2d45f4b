# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The power that the drum gives to the soil, revolution by revolution."""

from __future__ import annotations

import numpy as np

from roller_sim_ros.session import Block


class Load:
    """Keeps the last revolution's force and travel."""

    def __init__(self) -> None:
        self._blocks: list[Block] = []

    def observe(self, block: Block) -> None:
        """Take the next block."""
        self._blocks.append(block)

    def begin(self) -> None:
        """Begin a new revolution."""
        self._blocks = []

    def mean_power_w(self) -> float:
        """Return the mean power of the revolution so far, −∮ F_s dh over its time; 0 before the first.

        Made of the whole revolution at once, so that the size of the blocks has no part in it.
        """
        if not self._blocks:
            return 0.0
        force = np.concatenate([block.soil_force for block in self._blocks])
        height = np.concatenate([block.drum_height for block in self._blocks])
        duration_s = (len(force) - 1) * self._blocks[0].sample_period_s
        mean_force = (force[1:] + force[:-1]) / 2.0
        return float(-(mean_force * np.diff(height)).sum() / duration_s)
