# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The accelerometer's clock runs fast or slow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.faults.fault import Behaviour, Expectation, Fault, Stage
from roller_sim_ros.parameters.quantity import parameter


@dataclass(frozen=True)
class ClockSkew(Fault):
    """The sensor's time runs off; at a fixed sample rate so do its samples."""

    group: ClassVar[str] = "clock_skew"
    stage: ClassVar[Stage] = Stage.CLOCK

    skew_ppm: float = parameter(
        200.0, "ppm", "how much faster than without the fault it runs", minimum=-1e5, maximum=1e5
    )

    def expectation(self) -> Expectation:
        """Samples that go with the eccentric do not know the clock; others are as much off order."""
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=1.0)
