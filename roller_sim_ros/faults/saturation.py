# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The range shrinks: the signal's tops are cut off."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.faults.axes import axis_parameter, on
from roller_sim_ros.faults.fault import (
    Behaviour,
    Expectation,
    FaultRefused,
    Installed,
    SignalFault,
    Start,
)
from roller_sim_ros.parameters.quantity import parameter

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Saturation(SignalFault):
    """The sensor clips at a limit of its own, and counts it as it counts all clipping."""

    group: ClassVar[str] = "saturation"
    rank: ClassVar[int] = 5

    axis: str = axis_parameter()
    limit_m_s2: float = parameter(40.0, "m/s²", "the limit", minimum=0.1, maximum=1e5)

    def check(self, installed: Installed) -> None:
        """Refuse a limit beyond the sensor's own range."""
        if installed.range_m_s2 and self.limit_m_s2 >= installed.range_m_s2:
            raise FaultRefused(
                f"{self.group}: limit_m_s2 = {self.limit_m_s2:g} does nothing, the accelerometer's "
                f"range ends at {installed.range_m_s2:g} m/s²"
            )

    def begin(self, start: Start) -> Saturation:
        """Return the fault as it acts from now on."""
        del start
        return self

    def apply(
        self, vertical: Array, horizontal: Array, before: tuple[float, float]
    ) -> NDArray[np.uint8]:
        """Clip."""
        del before
        clipped = np.zeros(len(vertical), np.uint8)
        for name, axis in (("vertical", vertical), ("horizontal", horizontal)):
            if on(self.axis, name):
                clipped += np.abs(axis) > self.limit_m_s2
                np.clip(axis, -self.limit_m_s2, self.limit_m_s2, out=axis)
        return clipped

    def expectation(self) -> Expectation:
        """The messages count what is clipped, so a meter can know."""
        if self.axis == "horizontal":
            return Expectation(Behaviour.UNAFFECTED, tolerance_percent=0.1)
        return Expectation(Behaviour.FLAGGED, within_revolutions=2)
