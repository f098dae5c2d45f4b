# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A controller in the loop without ROS: the roller is stepped, the law answers its messages, as fast as it goes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from examples.controllers.measurement import Collector, Command, Law, Measurement
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.meters import Mode
from roller_sim_ros.offline.scenario_run import run_scenario, step_with_faults
from roller_sim_ros.scenario import Journal, Scenario, SiteMap, start_of
from roller_sim_ros.session import Master
from roller_sim_ros.wire.types import decode

BLOCK = 128
"""Samples from step to step: a whole revolution, as a lock step of one."""

JUMPING_RMV = 3.0
"""RMV above which the drum double-jumps, whether its motion repeats or not; without a jump it is some tenths."""


def drive(scenario: Scenario, law: Law, most_revolutions: int | None = None) -> SiteMap:
    """Run a scenario under a controller and return what was true, revolution by revolution.

    Parameters
    ----------
    scenario : Scenario
        What is driven.
    law : Law
        The controller.
    most_revolutions : int, optional
        After which the run is cut short.
    """
    emulator = Emulator(start_ns=0, **start_of(scenario)._asdict())
    journal, collector = Journal(emulator.session), Collector()
    take: dict[str, Callable[[Any], list[Measurement]]] = {
        "drum/acceleration": collector.acceleration,
        "meter": collector.meter,
        "exciter/state": collector.exciter_state,
    }
    done = 0
    while not arrived(emulator) and done != most_revolutions:
        messages = emulator.advance(BLOCK)
        assert emulator.block is not None  # it was just stepped
        journal.feed(emulator.block)
        done += 1
        for message in messages:
            if message.topic not in take:
                continue
            for measurement in take[message.topic](decode(message.data, message.type_name)):
                obey(emulator, law.update(measurement))
    return journal.map()


def alone(scenario: Scenario) -> SiteMap:
    """Run a scenario as it is, without a controller, and return what was true."""
    start = start_of(scenario)
    session = start.session()
    step = step_with_faults(session, start)
    return run_scenario(scenario, session, step, lambda _: None).site_map


def best_constant_mm(scenario: Scenario, least_mm: float = 0.4, halvings: int = 6) -> float:
    """Return the largest constant amplitude, mm, with which the drum never jumps, up to the scenario's own.

    It is looked for by halving the range; the first two windows of the meter, the start from rest, do not count.
    """
    low_mm, high_mm = least_mm, alone(scenario).amplitude_m[0] * 1e3
    for _ in range(halvings):
        middle_mm = 0.5 * (low_mm + high_mm)
        exciter = replace(scenario.exciter, amplitude_mm=middle_mm, programme=())
        found = alone(replace(scenario, exciter=exciter))
        if jumping(found.mode, found.rmv)[2 * found.window_revolutions :].any():
            high_mm = middle_mm
        else:
            low_mm = middle_mm
    return float(low_mm)


def arrived(emulator: Emulator) -> bool:
    """Return whether all is driven; driven by hand the roller stands at the lane's end."""
    session = emulator.session
    position = session.site.position
    return position.finished or (
        session.masters.travel is Master.CMD_VEL and not position.speed_m_s
    )


def jumping(mode: NDArray[np.int64], rmv: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which revolutions were in double jump, from true modes and RMV, all of the shape (revolutions,).

    Those whose mode is double or quad jump, and those whose RMV is above 3: on ground that changes a motion does not
    repeat, and its mode cannot be told.
    """
    jumps = np.isin(mode, (Mode.DOUBLE_JUMP, Mode.QUAD_JUMP))
    return np.asarray(jumps | (rmv > JUMPING_RMV))


def obey(emulator: Emulator, command: Command) -> None:
    """Let the roller do what a controller commands."""
    emulator.command(
        vibrate=True, frequency_hz=command.frequency_hz, amplitude_m=command.amplitude_m
    )
    if command.speed_m_s is not None:
        emulator.command_travel(command.speed_m_s)
