# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a scenario makes: configuration, site and programme, with which a session begins."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

from roller_sim_ros.faults import Scheduled
from roller_sim_ros.parameters import Configuration, ParameterError, Value, lookup
from roller_sim_ros.scenario.programme import ExciterProgramme
from roller_sim_ros.scenario.scenario import Scenario
from roller_sim_ros.sensors import Choice
from roller_sim_ros.session import Moment, Session
from roller_sim_ros.site import LaneSite, Position
from roller_sim_ros.site.declaration import members
from roller_sim_ros.soil_mechanics import machine_preset

_ELSEWHERE = (
    "machine.",
    "soil.",
    "exciter.kind",
    "exciter.tilt_rad",
    "exciter.vibrate",
    "exciter.frequency_hz",
    "exciter.amplitude_m",
    "recording.",
    "scenario.",
)
"""How parameters begin that a scenario says in sections of their own, or leaves to the run."""


def has_own_section(name: str) -> bool:
    """Return whether a scenario says a parameter in a section of its own, or not at all."""
    return name.startswith(_ELSEWHERE)


def configuration_of(scenario: Scenario) -> Configuration:
    """Return the configuration that a run of the scenario begins with.

    Raises
    ------
    ParameterError
        If a parameter is unknown, said elsewhere or refused.
    """
    for name, value in scenario.parameters.items():
        lookup(name, value)
        if has_own_section(name):
            raise ParameterError(
                name, value, "is said in another section of a scenario, or is the run's own"
            )
    configuration = Configuration().changed(
        {**_machine_values(scenario), **_exciter_values(scenario), **scenario.parameters}
    )
    soil = scenario.ground.soil(configuration.machine, configuration.soil)
    start = Moment(0.0, 0, Position(_start_m(scenario)))
    command = ExciterProgramme(configuration.exciter, scenario.exciter.programme).command(start)
    exciter = replace(
        configuration.exciter,
        vibrate=command.vibrate,
        frequency_hz=command.frequency_hz,
        amplitude_m=command.amplitude_m,
    )
    return replace(configuration, soil=soil, exciter=exciter)


def site_of(scenario: Scenario) -> LaneSite:
    """Return the lane with the roller at its start.

    Raises
    ------
    ParameterError
        If the ground is somewhere beyond what the model takes.
    """
    configuration = configuration_of(scenario)
    return LaneSite(
        scenario.lane,
        scenario.ground,
        scenario.travel,
        machine=configuration.machine,
        otherwise=configuration.soil,
        seed=scenario.seed,
        duration_s=scenario.duration_s,
    )


def programme_of(scenario: Scenario) -> ExciterProgramme:
    """Return what the exciter does."""
    base = Configuration().changed({**_machine_values(scenario), **_exciter_values(scenario)})
    return ExciterProgramme(base.exciter, scenario.exciter.programme)


class Start(NamedTuple):
    """What an emulator of a scenario is made of: its keyword arguments but the time of the start.

    A session alone takes the first four.
    """

    configuration: Configuration
    run_up: bool
    site: LaneSite
    programme: ExciterProgramme
    sensors: tuple[Choice, ...]
    faults: tuple[Scheduled, ...]
    seed: int
    scenario: str = ""

    def session(self) -> Session:
        """Return a session, without sensors and faults."""
        return Session(
            self.configuration, run_up=self.run_up, site=self.site, programme=self.programme
        )


def start_of(scenario: Scenario) -> Start:
    """Return all that a run of the scenario begins with, anew each time.

    Raises
    ------
    ParameterError
        If the scenario cannot be run.
    """
    return Start(
        configuration_of(scenario),
        scenario.exciter.run_up,
        site_of(scenario),
        programme_of(scenario),
        sensors_of(scenario),
        faults_of(scenario),
        scenario.seed,
        scenario.text,
    )


def sensors_of(scenario: Scenario) -> tuple[Choice, ...]:
    """Return the sensors as they are chosen from the registry."""
    return tuple(Choice(part.name, part.parameters) for part in scenario.sensors)


def faults_of(scenario: Scenario) -> tuple[Scheduled, ...]:
    """Return the faults as they are scheduled; a part of the scenario is its own window."""
    return tuple(Scheduled(part.id, part, part.parameters) for part in scenario.faults)


def _machine_values(scenario: Scenario) -> dict[str, Value]:
    part = scenario.machine
    values: dict[str, Value] = {} if part.preset is None else machine_preset(part.preset).values()
    for member in members(type(part)):
        value = getattr(part, member.name)
        if member.name != "preset" and value is not None:
            values[f"machine.{member.name}"] = value
    return values


def _exciter_values(scenario: Scenario) -> dict[str, Value]:
    part = scenario.exciter
    values: dict[str, Value] = {"exciter.vibrate": part.vibrate}
    if part.kind is not None:
        values["exciter.kind"] = part.kind
    if part.tilt_deg is not None:
        values["exciter.tilt_rad"] = math.radians(part.tilt_deg)
    if part.frequency_hz is not None:
        values["exciter.frequency_hz"] = part.frequency_hz
    if part.amplitude_mm is not None:
        values["exciter.amplitude_m"] = part.amplitude_mm / 1e3
    return values


def _start_m(scenario: Scenario) -> float:
    plan = scenario.travel
    if plan.start_m is not None:
        return plan.start_m
    return 0.0 if plan.direction == "forward" else scenario.lane.length_m
