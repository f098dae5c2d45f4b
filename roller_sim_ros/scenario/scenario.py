# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A scenario as it is written: declared once; the reader, the JSON Schema and the docs follow."""

from __future__ import annotations

from dataclasses import dataclass, field

from roller_sim_ros.parameters import ParameterError, Value
from roller_sim_ros.scenario.programme import ExciterPart
from roller_sim_ros.scenario.window import Window
from roller_sim_ros.site import GroundPlan, Lane, Plan
from roller_sim_ros.site.declaration import Record, declare, like
from roller_sim_ros.soil_mechanics import MACHINES


@dataclass(frozen=True)
class MachinePart(Record):
    """The roller, by name or by value; values win over the name's."""

    preset: str | None = declare(
        "roller by name, with its exciter's setting", default=None, choices=tuple(MACHINES)
    )
    frame_mass_kg: float | None = like("machine.frame_mass_kg")
    drum_mass_kg: float | None = like("machine.drum_mass_kg")
    drum_radius_m: float | None = like("machine.drum_radius_m")
    drum_width_m: float | None = like("machine.drum_width_m")
    eccentric_mass_kg: float | None = like("machine.eccentric_mass_kg")


@dataclass(frozen=True)
class SensorPart(Record):
    """A sensor and how it differs from what its name says."""

    name: str = declare("which sensor")
    parameters: dict[str, Value] = declare("its parameters by name", default={}, free=True)


@dataclass(frozen=True, kw_only=True)
class FaultPart(Window):
    """A fault and when it is active."""

    id: str = declare("which fault of the catalogue")
    parameters: dict[str, Value] = declare("its parameters by name", default={}, free=True)


@dataclass(frozen=True)
class Scenario(Record):
    """All of a run: what is driven over, how, with what, how it is measured and what fails.

    Attributes
    ----------
    path, text : str
        File it was read from, and what was in it; empty when it was made otherwise.
    """

    lane: Lane = declare("the lane")
    title: str = declare("what it is, in a few words", default="")
    description: str = declare("what it shows", default="")
    machine: MachinePart = declare("the roller", default=MachinePart())
    travel: Plan = declare("how the roller drives", default=Plan())
    ground: GroundPlan = declare("the ground along the lane", default=GroundPlan())
    exciter: ExciterPart = declare("the exciter and its programme", default=ExciterPart())
    sensors: tuple[SensorPart, ...] = declare(
        "the sensors on the drum; left out: the ideal one", default=()
    )
    faults: tuple[FaultPart, ...] = declare("what fails, and when", default=())
    parameters: dict[str, Value] = declare(
        "other parameters by their dotted names, SI units, as in half_space.model",
        default={},
        free=True,
    )
    duration_s: float | None = declare(
        "when the run ends; left out: when all passes are driven",
        default=None,
        minimum=0.1,
        maximum=1e6,
    )
    seed: int = declare("seed of all random numbers", default=0, minimum=0, maximum=2**63 - 1)
    path: str = field(default="", compare=False)
    text: str = field(default="", compare=False, repr=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.travel.speed_m_s == 0.0 and self.duration_s is None:
            raise ParameterError(
                "duration_s", None, "must be given for a roller that stands (travel.speed_m_s 0)"
            )
