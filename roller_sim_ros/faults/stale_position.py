"""Position and speed that no longer follow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.faults.fault import Behaviour, Expectation, Fault, Installed, Stage
from roller_sim_ros.parameters.quantity import parameter
from roller_sim_ros.sensors import Slot


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
