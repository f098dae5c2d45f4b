# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""CCV, the compaction control value: all that is not the fundamental, over the fundamental and its half."""

from __future__ import annotations

from typing import ClassVar

from roller_sim_ros.meters.harmonics import Harmonics


class Ccv:
    """CCV = 100 (A_0.5 + A_1.5 + A_2 + A_2.5 + A_3) / (A_0.5 + A_1) (Sakai)."""

    name: ClassVar[str] = "ccv"
    label: ClassVar[str] = "CCV"
    unit: ClassVar[str] = ""
    orders: ClassVar[tuple[float, ...]] = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)
    source: ClassVar[str] = "Sakai Heavy Industries, as commonly cited (NCHRP report 676, 2010)"
    verified: ClassVar[bool] = False

    constant: ClassVar[float] = 100.0

    def value(self, harmonics: Harmonics) -> float:
        """Return CCV, NaN where the amplitudes are unknown."""
        half, one, *higher = (harmonics.amplitude(order) for order in self.orders)
        return self.constant * (half + sum(higher)) / (half + one)
