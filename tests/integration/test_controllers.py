# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The example controllers as nodes of their own, in lock step over DDS: the run is that without ROS, bit for bit."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from examples.controllers.figures import LAWS
from examples.controllers.lock_step import REMAPPED, LockStep, process
from examples.controllers.measurement import Command, Measurement, nanoseconds
from examples.controllers.offline import drive
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.scenario import read_scenario

REVOLUTIONS = 90


class Noted:
    """A law, and what it answered to which measurement."""

    def __init__(self, name: str) -> None:
        self.law = LAWS[name]()
        self.answers: dict[int, Command] = {}

    def update(self, measurement: Measurement) -> Command:
        answer = self.answers[measurement.stamp_ns] = self.law.update(measurement)
        return answer


@contextmanager
def node(name: str, domain: int, folder: Path, *arguments: str) -> Iterator[None]:
    environment = {
        **os.environ,
        "ROS_DOMAIN_ID": str(domain),
        "ROS_LOG_DIR": str(folder),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    given = ("--ros-args", *REMAPPED, *arguments)
    with process(f"examples.controllers.{name}", *given, env=environment):
        yield


@pytest.mark.parametrize("name", LAWS)
def test_controller_in_lock_step_does_what_its_law_does_without_ros(
    stepper, stepped_sim, scenario: Path, tmp_path: Path, name: str
) -> None:
    del stepper  # it has set the roller to its start
    domain, _ = stepped_sim
    with node(name, domain, tmp_path), LockStep(domain) as lock_step:
        run = lock_step.drive(REVOLUTIONS)
    law = Noted(name)
    expected = drive(read_scenario(scenario), law, REVOLUTIONS)
    assert run.unheard == 0
    # It may join some revolutions late: before the first window is full nothing is decided.
    assert REVOLUTIONS - 8 <= len(run.commands) <= REVOLUTIONS
    for command in run.commands:
        own = law.answers[nanoseconds(command.header.stamp)]
        assert (command.frequency, command.amplitude) == (own.frequency_hz, own.amplitude_m)
    assert len({(command.frequency, command.amplitude) for command in run.commands}) > 1
    np.testing.assert_array_equal(run.true_rmv, expected.rmv)
    np.testing.assert_array_equal(run.true_mode, expected.mode)


def test_roller_takes_several_revolutions_and_laws_their_parameters(
    stepper, stepped_sim, tmp_path: Path
) -> None:
    del stepper
    domain, _ = stepped_sim
    parameters = ("-p", "cut:=0.5", "-p", "threshold:=0.001")
    with node("jump_guard", domain, tmp_path, *parameters), LockStep(domain) as lock_step:
        run = lock_step.drive(30, revolutions_per_step=4)
    assert len(run.true_rmv) == 30
    assert run.unheard == 0
    assert run.commands[0].amplitude == 1.4e-3
    assert run.commands[-1].amplitude == 0.7e-3


def test_waiting_in_vain_says_for_what(own_domain: int) -> None:
    with (
        LockStep(own_domain, "nobody", patience_s=0.2) as lock_step,
        pytest.raises(RollerSimError, match=r"a roller in lock step: did not come within 0\.2 s"),
    ):
        lock_step.drive(1)
