# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The sensitivity changes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.faults.axes import axis_parameter, on
from roller_sim_ros.faults.fault import Behaviour, Expectation, SignalFault, Start
from roller_sim_ros.parameters.quantity import parameter

Array = NDArray[np.float64]


@dataclass(frozen=True)
class GainChange(SignalFault):
    """The signal is multiplied by a factor."""

    group: ClassVar[str] = "gain_change"
    rank: ClassVar[int] = 1

    axis: str = axis_parameter()
    factor: float = parameter(0.8, "", "the factor", minimum=0.01, maximum=10.0)

    def begin(self, start: Start) -> GainChange:
        """Return the fault as it acts from now on."""
        del start
        return self

    def apply(self, vertical: Array, horizontal: Array, before: tuple[float, float]) -> None:
        """Multiply."""
        del before
        if on(self.axis, "vertical"):
            vertical *= self.factor
        if on(self.axis, "horizontal"):
            horizontal *= self.factor

    def expectation(self) -> Expectation:
        """A ratio of amplitudes does not know the gain."""
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=5.0)
