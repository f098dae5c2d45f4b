# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Noise beyond what the data sheet states."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from roller_sim_ros.faults.axes import axis_parameter, on
from roller_sim_ros.faults.fault import Behaviour, Expectation, SignalFault, Start
from roller_sim_ros.parameters.quantity import parameter

Array = NDArray[np.float64]


@dataclass(frozen=True)
class NoiseBurst(SignalFault):
    """White noise is added, other numbers on either axis."""

    group: ClassVar[str] = "noise_burst"
    rank: ClassVar[int] = 3

    axis: str = axis_parameter()
    deviation_m_s2: float = parameter(
        2.0, "m/s²", "standard deviation of what is added", minimum=0.0, maximum=1e4
    )

    def begin(self, start: Start) -> _Noise:
        """Return the fault as it acts from now on."""
        return _Noise(self, start.random)

    def expectation(self) -> Expectation:
        """White noise σ gives each amplitude a part of σ √(4/N) over the N samples of a window."""
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=15.0)


class _Noise:
    def __init__(self, fault: NoiseBurst, random: Generator) -> None:
        self._fault = fault
        self._random = random

    def apply(self, vertical: Array, horizontal: Array, before: tuple[float, float]) -> None:
        del before
        fault = self._fault
        noise = fault.deviation_m_s2 * self._random.standard_normal((len(vertical), 2))
        if on(fault.axis, "vertical"):
            vertical += noise[:, 0]
        if on(fault.axis, "horizontal"):
            horizontal += noise[:, 1]
