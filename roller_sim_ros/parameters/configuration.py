# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""All parameter groups together, and their flat form with dotted names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from difflib import get_close_matches
from typing import Any

from roller_sim_ros.parameters.exciter import Exciter
from roller_sim_ros.parameters.half_space import HalfSpace
from roller_sim_ros.parameters.machine import Machine
from roller_sim_ros.parameters.operation import (
    Meter,
    Pacing,
    Recording,
    Sampling,
    ScenarioFile,
    Travel,
)
from roller_sim_ros.parameters.quantity import (
    ParameterError,
    ParameterGroup,
    Quantity,
    Value,
    declared,
)
from roller_sim_ros.parameters.soil import Soil

GROUPS: dict[str, type[ParameterGroup]] = {
    item.group: item
    for item in (
        Machine,
        Exciter,
        Travel,
        Soil,
        HalfSpace,
        Sampling,
        Meter,
        Pacing,
        ScenarioFile,
        Recording,
    )
}


@dataclass(frozen=True)
class Configuration:
    """Everything a run is made from; immutable, checked on construction."""

    machine: Machine = field(default_factory=Machine)
    exciter: Exciter = field(default_factory=Exciter)
    travel: Travel = field(default_factory=Travel)
    soil: Soil = field(default_factory=Soil)
    half_space: HalfSpace = field(default_factory=HalfSpace)
    sampling: Sampling = field(default_factory=Sampling)
    meter: Meter = field(default_factory=Meter)
    pacing: Pacing = field(default_factory=Pacing)
    scenario: ScenarioFile = field(default_factory=ScenarioFile)
    recording: Recording = field(default_factory=Recording)

    def flat(self) -> dict[str, Value]:
        """Return {dotted name: SI value} of all parameters."""
        return {
            f"{item.name}.{name}": getattr(getattr(self, item.name), name)
            for item in fields(self)
            for name, _, _ in declared(GROUPS[item.name])
        }

    def changed(self, values: Mapping[str, object]) -> Configuration:
        """Return a copy with the dotted names of `values` replaced, all checked.

        Raises
        ------
        ParameterError
            If a name is unknown (the message offers the nearest) or a value is refused.
        """
        by_group: dict[str, dict[str, Any]] = {}
        for name, value in values.items():
            lookup(name, value)
            group, _, short = name.partition(".")
            by_group.setdefault(group, {})[short] = value
        groups = {
            group: replace(getattr(self, group), **changes) for group, changes in by_group.items()
        }
        return replace(self, **groups)


def all_parameters() -> Iterator[tuple[str, Quantity, Value]]:
    """Yield (dotted name, quantity, default) of every parameter."""
    for prefix, group in GROUPS.items():
        for name, quantity, default in declared(group):
            yield f"{prefix}.{name}", quantity, default


PARAMETERS: dict[str, tuple[Quantity, Value]] = {
    name: (quantity, default) for name, quantity, default in all_parameters()
}


def lookup(name: str, value: object = None) -> tuple[Quantity, Value]:
    """Return (quantity, default) of a dotted name.

    Raises
    ------
    ParameterError
        If there is no such parameter.
    """
    if name not in PARAMETERS:
        near = get_close_matches(name, PARAMETERS, n=1, cutoff=0.5)
        hint = f"; did you mean {near[0]}?" if near else ""
        raise ParameterError(name, value, f"there is no such parameter{hint}")
    return PARAMETERS[name]
