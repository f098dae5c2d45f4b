# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""RMV, the resonance meter value: how much the drum's motion repeats only after two revolutions."""

from __future__ import annotations

from typing import ClassVar

from roller_sim_ros.meters.harmonics import Harmonics


class Rmv:
    """RMV = 300 A_0.5 / A_1, also called bouncing value; zero unless the motion's period is even."""

    name: ClassVar[str] = "rmv"
    label: ClassVar[str] = "RMV"
    unit: ClassVar[str] = ""
    orders: ClassVar[tuple[float, ...]] = (0.5, 1.0)
    source: ClassVar[str] = (
        "as commonly cited (Geodynamik; Sandström and Pettersson, TRB 2004); some machines use 100 instead "
        "of 300, and the value that means bouncing is a setting of each machine"
    )
    verified: ClassVar[bool] = False

    constant: ClassVar[float] = 300.0

    def value(self, harmonics: Harmonics) -> float:
        """Return RMV, NaN where the amplitudes are unknown."""
        return self.constant * harmonics.amplitude(0.5) / harmonics.amplitude(1.0)
