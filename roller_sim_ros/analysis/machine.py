# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a bag says of the machine that made it, for the meter values that need to know it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from roller_sim_ros.analysis.bag import Bag
from roller_sim_ros.analysis.topics import Selection
from roller_sim_ros.meters.drum import Drum
from roller_sim_ros.parameters import Exciter, Machine, ParameterError, Value
from roller_sim_ros.parameters.quantity import ParameterGroup, declared

AMPLITUDE = "exciter.amplitude_m"


@dataclass(frozen=True)
class MachineFacts:
    """The machine as its parameters have it.

    Attributes
    ----------
    drum : Drum
        Masses and drum.
    amplitude_m : float
        Nominal amplitude at the start; NaN when it is not stated, or when messages of the exciter tell better.
    """

    drum: Drum
    amplitude_m: float


def machine_facts(bag: Bag, selection: Selection) -> MachineFacts | None:
    """Return the machine that the bag's parameters, or else its topic ``machine``, state in full.

    Parameters
    ----------
    bag : Bag
        The bag.
    selection : Selection
        Topics of the roller.

    Returns
    -------
    MachineFacts or None
        None when something is missing or no parameter could be so.
    """
    facts: Mapping[str, str] = bag.parameters
    if not facts and selection.machine:
        for received in bag.messages({selection.machine}):
            facts = {item.key: item.value for item in received.message.values}
            break
    try:
        machine = Machine(**_values(Machine, facts))  # type: ignore[arg-type]
        directions = _values(Exciter, facts, ("kind", "tilt_rad"))
        drum = Drum.of(machine, Exciter(**directions))  # type: ignore[arg-type]
        amplitude = math.nan if selection.exciter else float(facts.get(AMPLITUDE, math.nan))
    except (KeyError, ValueError, ParameterError):
        return None
    return MachineFacts(drum, amplitude)


def _values(
    group: type[ParameterGroup], facts: Mapping[str, str], names: tuple[str, ...] = ()
) -> dict[str, Value]:
    """Return the parameters of a group, or some of them, from their texts."""
    return {
        name: type(default)(facts[f"{group.group}.{name}"])
        for name, _, default in declared(group)
        if not names or name in names
    }
