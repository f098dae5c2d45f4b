"""Which sensors and faults a scenario may name."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches

from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.scenario.scenario import FaultPart, SensorPart
from roller_sim_ros.sensors import SENSORS


def check_sensors(parts: Sequence[SensorPart]) -> None:
    """Check the sensors against the registry.

    Raises
    ------
    ParameterError
        If there is no sensor of a name; the message offers the nearest.
    """
    for index, part in enumerate(parts):
        if part.name not in SENSORS:
            near = get_close_matches(part.name, SENSORS, n=1, cutoff=0.5)
            offer = f"did you mean {near[0]}?" if near else f"there are {', '.join(SENSORS)}"
            raise ParameterError(
                f"sensors[{index}].name", part.name, f"there is no such sensor; {offer}"
            )


def check_faults(parts: Sequence[FaultPart]) -> None:
    """Check the faults."""
