# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Messages that come twice."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.faults.fault import (
    Behaviour,
    Chosen,
    Expectation,
    MessageFault,
    Parcel,
    Start,
)
from roller_sim_ros.parameters.quantity import parameter


@dataclass(frozen=True)
class Duplicate(MessageFault):
    """The messages of some revolutions come twice in a row."""

    group: ClassVar[str] = "duplicate"

    probability: float = parameter(
        0.5, "", "of each revolution to be hit", minimum=0.0, maximum=1.0
    )

    def begin(self, start: Start) -> _Twice:
        """Return the fault as it acts from now on."""
        return _Twice(Chosen(start, self.probability))

    def expectation(self) -> Expectation:
        """The samples' index tells."""
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=0.1)


class _Twice:
    def __init__(self, chosen: Chosen) -> None:
        self._chosen = chosen

    def pass_on(self, parcel: Parcel) -> list[Parcel]:
        return [parcel] * (2 if self._chosen.hits(parcel.reading.revolution) else 1)
