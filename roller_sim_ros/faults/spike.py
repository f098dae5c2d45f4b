# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Single readings that are far off."""

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
class Spike(SignalFault):
    """Some samples are off by a height up or down."""

    group: ClassVar[str] = "spike"
    rank: ClassVar[int] = 4

    axis: str = axis_parameter()
    height_m_s2: float = parameter(100.0, "m/s²", "by how much", minimum=0.0, maximum=1e5)
    probability: float = parameter(0.0005, "", "of each sample to be off", minimum=0.0, maximum=1.0)

    def begin(self, start: Start) -> _Spikes:
        """Return the fault as it acts from now on."""
        return _Spikes(self, start.random)

    def expectation(self) -> Expectation:
        """A spike of height h is a flat spectrum of 2 h/N over the N samples of a window."""
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=15.0)


class _Spikes:
    def __init__(self, fault: Spike, random: Generator) -> None:
        self._fault = fault
        self._random = random

    def apply(self, vertical: Array, horizontal: Array, before: tuple[float, float]) -> None:
        del before
        fault = self._fault
        # Whether, and which way: two numbers a sample, so that the pieces' size has no part in it.
        numbers = self._random.random((len(vertical), 2))
        off = np.where(numbers[:, 1] < 0.5, -fault.height_m_s2, fault.height_m_s2)
        off[numbers[:, 0] >= fault.probability] = 0.0
        if on(fault.axis, "vertical"):
            vertical += off
        if on(fault.axis, "horizontal"):
            horizontal += off
