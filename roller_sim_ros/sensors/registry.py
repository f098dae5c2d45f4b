# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""All sensors by name; a new one is one file and one line here."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from enum import Enum
from typing import Any, ClassVar, TypeVar

from roller_sim_ros.parameters import ParameterError, ParameterGroup, Value
from roller_sim_ros.parameters.quantity import declared, parameter
from roller_sim_ros.sensors.accelerometer import Accelerometer
from roller_sim_ros.sensors.gnss import Gnss, GnssSheet
from roller_sim_ros.sensors.ideal import IdealAccelerometer
from roller_sim_ros.sensors.odometry import Odometry, OdometrySheet
from roller_sim_ros.sensors.presets import MEMS_10G, MEMS_50G, Preset
from roller_sim_ros.sensors.sensor import Kind
from roller_sim_ros.sensors.sheet import AccelerometerSheet
from roller_sim_ros.sensors.tacho import Tacho, TachoSheet

Group = TypeVar("Group", bound=ParameterGroup)


class Slot(Enum):
    """What a sensor measures; there is one sensor for each at most."""

    ACCELERATION = "acceleration of the drum"
    TACHO = "pulses of the eccentric"
    SPEED = "travel speed and dead reckoning"
    POSITION = "position by satellite"


@dataclass(frozen=True)
class SensorModel:
    """A sensor that can be chosen by name.

    Attributes
    ----------
    doc : str
        What it is, in a sentence without a full stop.
    slot : Slot
        What it measures.
    group : type of ParameterGroup
        Its parameters.
    make : callable
        Makes the sensor from its parameters and the seed of the run.
    preset : Preset or None
        Values that differ from the parameters' defaults.
    """

    doc: str
    slot: Slot
    group: type[ParameterGroup]
    make: Callable[[Any, int], Any]
    preset: Preset | None = None

    def parameters(self, values: Mapping[str, Value]) -> ParameterGroup:
        """Return the sensor's parameters, some of them changed.

        Raises
        ------
        ParameterError
            If a name is unknown or a value is refused; `name` is that of the parameter alone.
        """
        preset = self.preset.values() if self.preset else {}
        return parameters_of(self.group, values, preset)


def parameters_of(
    group: type[Group], values: Mapping[str, Value], preset: Mapping[str, Value] | None = None
) -> Group:
    """Return the parameters of a group, some of them changed.

    Raises
    ------
    ParameterError
        If a name is unknown or a value is refused; `name` is that of the parameter alone.
    """
    known = [name for name, _, _ in declared(group)]
    for name, value in values.items():
        if name not in known:
            near = get_close_matches(name, known, n=1, cutoff=0.5)
            offer = (
                f"did you mean {near[0]}?" if near else f"there are {', '.join(known) or 'none'}"
            )
            raise ParameterError(name, value, f"there is no such parameter; {offer}")
    try:
        return group(**{**(preset or {}), **values})
    except ParameterError as error:
        name = error.name.rpartition(".")[2]
        raise ParameterError(name, error.value, error.reason) from None


@dataclass(frozen=True)
class IdealSheet(ParameterGroup):
    """The ideal accelerometer."""

    group: ClassVar[str] = "ideal"

    kind: str = parameter(
        Kind.COORDINATE_ACCELERATION.label,
        "",
        "what is delivered: the second derivative of the position, or what an accelerometer feels",
        choices=tuple(kind.label for kind in Kind),
    )


def _ideal(sheet: IdealSheet, seed: int) -> IdealAccelerometer:
    del seed
    return IdealAccelerometer(Kind[sheet.kind.upper()])


def _accelerometer(preset: Preset) -> SensorModel:
    return SensorModel(preset.doc, Slot.ACCELERATION, AccelerometerSheet, Accelerometer, preset)


SENSORS: dict[str, SensorModel] = {
    "ideal": SensorModel("the truth in single precision", Slot.ACCELERATION, IdealSheet, _ideal),
    "accelerometer": _accelerometer(Preset("an accelerometer without errors but those stated")),
    "mems_50g": _accelerometer(MEMS_50G),
    "mems_10g": _accelerometer(MEMS_10G),
    "tacho": SensorModel("one pulse per revolution", Slot.TACHO, TachoSheet, Tacho),
    "odometry": SensorModel(
        "travel speed, and the way that it adds up to", Slot.SPEED, OdometrySheet, Odometry
    ),
    "gnss": SensorModel("position by satellite, RTK", Slot.POSITION, GnssSheet, Gnss),
}
"""All sensors by the name that a scenario gives them."""
