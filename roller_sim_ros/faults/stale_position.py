# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Position and speed that no longer follow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

from roller_sim_ros.faults.fault import Behaviour, Expectation, Fault, Installed, Stage
from roller_sim_ros.parameters.quantity import parameter
from roller_sim_ros.sensors import Fix, Slot, Travelled

Measured = TypeVar("Measured", Fix, Travelled)


@dataclass(frozen=True)
class StalePosition(Fault):
    """The last position, the last speed are repeated."""

    group: ClassVar[str] = "stale_position"
    stage: ClassVar[Stage] = Stage.POSITION

    what: str = parameter(
        "position",
        "",
        "what is stale: position by satellite, or travel speed with its dead reckoning",
        choices=("position", "speed"),
    )
    new_stamps: bool = parameter(
        True, "", "whether the old values come with new stamps, and so look fresh"
    )

    @property
    def slot(self) -> Slot:
        """What is stale."""
        return Slot.POSITION if self.what == "position" else Slot.SPEED

    def check(self, installed: Installed) -> None:
        """Refuse the fault where nothing measures what is to be stale."""
        self.require(installed, self.slot)

    def expectation(self) -> Expectation:
        """The meter's value does not need the position; where it is put on a map is another matter."""
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=0.1)


class Held:
    """The last measurement that was not stale."""

    def __init__(self) -> None:
        self._last: Any = None

    def follow(self, measured: Measured, fault: StalePosition | None) -> Measured:
        """Return a measurement as it is delivered; it has a field ``time_s``.

        Parameters
        ----------
        measured : named tuple
            As the sensor has it.
        fault : StalePosition, optional
            The fault, while it is active.
        """
        if fault is None or self._last is None:
            self._last = measured
            return measured
        held: Measured = self._last
        if fault.new_stamps:
            held = held._replace(time_s=measured.time_s)
        return held
