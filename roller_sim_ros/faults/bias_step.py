# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The reading is off by a constant from one sample to the next."""

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
class BiasStep(SignalFault):
    """A constant is added."""

    group: ClassVar[str] = "bias_step"
    rank: ClassVar[int] = 2

    axis: str = axis_parameter()
    bias_m_s2: float = parameter(2.0, "m/s²", "what is added", minimum=-1e4, maximum=1e4)

    def begin(self, start: Start) -> BiasStep:
        """Return the fault as it acts from now on."""
        del start
        return self

    def apply(self, vertical: Array, horizontal: Array, before: tuple[float, float]) -> None:
        """Add the constant."""
        del before
        if on(self.axis, "vertical"):
            vertical += self.bias_m_s2
        if on(self.axis, "horizontal"):
            horizontal += self.bias_m_s2

    def expectation(self) -> Expectation:
        """No harmonic has a part in a constant; the step itself passes through one window.

        A step of b in the middle of N revolutions is a line of 2 b/(π N) at order 1/N and less at the orders in use.
        """
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=max(1.0, abs(self.bias_m_s2)))
