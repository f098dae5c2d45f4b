# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Pulses of the tacho that do not come."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.faults.fault import (
    Behaviour,
    Chosen,
    Expectation,
    Fault,
    Installed,
    Stage,
    Start,
)
from roller_sim_ros.parameters.quantity import parameter
from roller_sim_ros.sensors import Slot


@dataclass(frozen=True)
class LostPulse(Fault):
    """Some pulses of the tacho are lost."""

    group: ClassVar[str] = "lost_pulse"
    stage: ClassVar[Stage] = Stage.TACHO

    probability: float = parameter(0.3, "", "of each pulse to be lost", minimum=0.0, maximum=1.0)

    def check(self, installed: Installed) -> None:
        """Refuse the fault where there is no tacho."""
        self.require(installed, Slot.TACHO)

    def begin(self, start: Start) -> Chosen:
        """Return what decides on the pulses."""
        return Chosen(start, self.probability)

    def expectation(self) -> Expectation:
        """The samples carry the eccentric's phase; a meter that goes by pulses bridges single ones."""
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=1.0)
