# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Checks what a scenario says of sensors and faults against their registries."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from roller_sim_ros.faults import FaultRefused, Installed, conflict, make_fault
from roller_sim_ros.faults.schedule import surely_overlap
from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.scenario.scenario import FaultPart, SensorPart
from roller_sim_ros.sensors import AccelerometerSheet, Choice, Slot, Suite


def check_instruments(sensors: Sequence[SensorPart], faults: Sequence[FaultPart]) -> None:
    """Check that the sensors can be, and that the faults can be with them and with each other.

    Raises
    ------
    ParameterError
        If not; `name` is the key in the file, as in ``faults[2].parameters.factor``.
    """
    suite = Suite([Choice(part.name, part.parameters) for part in sensors])
    sheet = suite.sheets[Slot.ACCELERATION]
    range_m_s2 = sheet.range_m_s2 if isinstance(sheet, AccelerometerSheet) else 0.0
    installed = Installed(suite.slots, range_m_s2)
    made = []
    for index, part in enumerate(faults):
        try:
            fault = make_fault(part.id, part.parameters)
            fault.check(installed)
        except FaultRefused as error:
            raise ParameterError(f"faults[{index}].id", part.id, str(error)) from None
        except ParameterError as error:
            name = f"faults[{index}].parameters.{error.name}"
            raise ParameterError(name, error.value, error.reason) from None
        made.append(fault)
    for (index, one), (other_index, other) in combinations(enumerate(made), 2):
        reason = conflict(one, other)
        if reason and surely_overlap(faults[index], faults[other_index]):
            raise ParameterError(
                f"faults[{other_index}].id",
                faults[other_index].id,
                f"cannot be together with faults[{index}]: {reason}",
            )
