# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The sensors of a roller, one for each thing measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import Any

from roller_sim_ros.parameters import ParameterError, ParameterGroup, Value
from roller_sim_ros.sensors.registry import SENSORS, Slot
from roller_sim_ros.sensors.sensor import Sensor

IDEAL = "ideal"


@dataclass(frozen=True)
class Choice:
    """A sensor by name, and how it differs from what its name says.

    Attributes
    ----------
    name : str
        Of the registry.
    parameters : mapping
        What differs.
    """

    name: str
    parameters: Mapping[str, Value] = field(default_factory=dict)


class Suite:
    """Sensors made from choices; an ideal accelerometer where none is chosen.

    Parameters
    ----------
    choices : sequence of Choice
        Which.
    seed : int
        Of the run; every error of every sensor has random numbers of its own.

    Attributes
    ----------
    sheets : dict
        Parameters of what there is, by what it measures.
    accelerometer : Sensor
        The accelerometer.

    Raises
    ------
    ParameterError
        If there is no sensor of a name, a parameter is unknown or refused, or two measure the same; `name` is that
        of the choice, as in ``sensors[0].parameters.range_m_s2``.
    """

    def __init__(self, choices: Sequence[Choice] = (), seed: int = 0) -> None:
        self.sheets: dict[Slot, ParameterGroup] = {}
        self._sensors: dict[Slot, Any] = {}
        for index, choice in enumerate(choices):
            self._add(f"sensors[{index}]", choice, seed)
        if Slot.ACCELERATION not in self._sensors:
            self._add("sensors", Choice(IDEAL), seed)
        self.accelerometer: Sensor = self._sensors[Slot.ACCELERATION]

    @property
    def slots(self) -> frozenset[Slot]:
        """What is measured."""
        return frozenset(self._sensors)

    def get(self, slot: Slot) -> Any:
        """Return the sensor that measures something, None where there is none."""
        return self._sensors.get(slot)

    def _add(self, at: str, choice: Choice, seed: int) -> None:
        if choice.name not in SENSORS:
            near = get_close_matches(choice.name, SENSORS, n=1, cutoff=0.5)
            offer = f"did you mean {near[0]}?" if near else f"there are {', '.join(SENSORS)}"
            raise ParameterError(f"{at}.name", choice.name, f"there is no such sensor; {offer}")
        model = SENSORS[choice.name]
        if model.slot in self._sensors:
            raise ParameterError(
                f"{at}.name", choice.name, f"there is a sensor for the {model.slot.value} already"
            )
        try:
            sheet = model.parameters(choice.parameters)
        except ParameterError as error:
            name = f"{at}.parameters.{error.name}"
            raise ParameterError(name, error.value, error.reason) from None
        self.sheets[model.slot] = sheet
        self._sensors[model.slot] = model.make(sheet, seed)
