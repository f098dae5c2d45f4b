# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Messages that come late."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.faults.fault import Behaviour, Expectation, MessageFault, Parcel, Start
from roller_sim_ros.parameters.quantity import parameter

_TWICE = "messages that are held back twice have no order that is defined"


@dataclass(frozen=True)
class Delay(MessageFault):
    """Messages come late, their stamps as they were; none overtakes another."""

    group: ClassVar[str] = "delay"
    excludes: ClassVar[dict[str, str]] = {"reordered": _TWICE}

    delay_s: float = parameter(0.2, "s", "by how much", minimum=0.0, maximum=60.0)

    def begin(self, start: Start) -> Delay:
        """Return the fault as it acts from now on."""
        del start
        return self

    def pass_on(self, parcel: Parcel) -> list[Parcel]:
        """Hold a reading back."""
        return [parcel._replace(late_s=parcel.late_s + self.delay_s)]

    def expectation(self) -> Expectation:
        """Late samples are as good as others."""
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=0.1)
