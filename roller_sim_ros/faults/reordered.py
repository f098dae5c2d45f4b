# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Messages in the wrong order."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.faults.delay import Delay
from roller_sim_ros.faults.fault import (
    Behaviour,
    Chosen,
    Expectation,
    MessageFault,
    Parcel,
    Start,
)
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.parameters.quantity import parameter


@dataclass(frozen=True)
class Reordered(MessageFault):
    """The messages of some revolutions come after those of the next one."""

    group: ClassVar[str] = "reordered"
    excludes: ClassVar[dict[str, str]] = {Delay.group: Delay.excludes["reordered"]}

    probability: float = parameter(
        0.3, "", "of each revolution to be hit", minimum=0.0, maximum=1.0
    )

    def begin(self, start: Start) -> _Late:
        """Return the fault as it acts from now on."""
        return _Late(Chosen(start, self.probability))

    def expectation(self) -> Expectation:
        """The samples' index goes back."""
        return Expectation(Behaviour.FLAGGED, within_revolutions=20)


class _Late:
    def __init__(self, chosen: Chosen) -> None:
        self._chosen = chosen

    def pass_on(self, parcel: Parcel) -> list[Parcel]:
        revolution = parcel.reading.revolution
        if not self._chosen.hits(revolution):
            return [parcel]
        return [parcel._replace(held_until=(revolution + 2) * SAMPLES_PER_REVOLUTION)]
