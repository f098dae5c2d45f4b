# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the command line gives to the benchmarks."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Options:
    """How long the measurements are.

    Attributes
    ----------
    seconds : float
        Of lateness, at each frequency.
    minutes : float
        Of counting lost samples.
    quick : bool
        Only whether all works: the figures are rough.
    """

    seconds: float = 60.0
    minutes: float = 5.0
    quick: bool = False

    def rounds(self, number: int) -> int:
        """Return how often something is repeated that is to be repeated so often."""
        return max(2, number // 10) if self.quick else number
