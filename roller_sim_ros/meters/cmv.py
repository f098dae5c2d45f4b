# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""CMV, the compaction meter value: how much the drum's motion is distorted at twice its frequency."""

from __future__ import annotations

from typing import ClassVar

from roller_sim_ros.meters.harmonics import Harmonics


class Cmv:
    """CMV = 300 A_2 / A_1 (Geodynamik)."""

    name: ClassVar[str] = "cmv"
    label: ClassVar[str] = "CMV"
    unit: ClassVar[str] = ""
    orders: ClassVar[tuple[float, ...]] = (1.0, 2.0)
    source: ClassVar[str] = (
        "the ratio: US patent 4103554 (Thurner, Geodynamik); the constant 300: Sandström and Pettersson, "
        "Intelligent systems for QA/QC in soil compaction, TRB 2004"
    )
    verified: ClassVar[bool] = False
    """The ratio was read in the patent; the constant is as commonly cited."""

    constant: ClassVar[float] = 300.0

    def value(self, harmonics: Harmonics) -> float:
        """Return CMV, NaN where the amplitudes are unknown."""
        return self.constant * harmonics.amplitude(2.0) / harmonics.amplitude(1.0)
