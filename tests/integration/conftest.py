# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Fixtures: a domain of one's own, and one roller that the tests which leave it as it was may share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from roller_sim_ros.bench.domain import own_domain as locked_domain
from roller_sim_ros.msg import Result
from roller_sim_ros.srv import ResetSimulation
from tests.integration.harness import Client, Sim


@pytest.fixture
def own_domain() -> Iterator[int]:
    with locked_domain() as number:
        yield number


@pytest.fixture
def start(own_domain: int, tmp_path) -> Iterator[Callable[..., Sim]]:
    """Start a roller in the test's own domain; it is gone when the test ends."""
    with ExitStack() as stack:
        yield lambda *arguments, **environment: stack.enter_context(
            Sim(tmp_path, own_domain, *arguments, **environment)
        )


@pytest.fixture
def client(own_domain: int) -> Iterator[Client]:
    with Client(own_domain) as client:
        yield client


@pytest.fixture(scope="session")
def shared_domain() -> Iterator[int]:
    with locked_domain() as number:
        yield number


@pytest.fixture(scope="session")
def shared_sim(shared_domain: int, tmp_path_factory) -> Iterator[Sim]:
    """Return a roller that follows commands quickly."""
    folder = tmp_path_factory.mktemp("shared_sim")
    quick = ("-p", "exciter.frequency_rate_hz_per_s:=100.0")
    with Sim(folder, shared_domain, "--ros-args", *quick) as sim:
        yield sim


@pytest.fixture(scope="session")
def resident(shared_domain: int, shared_sim: Sim) -> Iterator[Client]:  # noqa: ARG001
    with Client(shared_domain) as client:
        yield client


SCENARIO = """\
title: a lane with everything
lane: {length_m: 6}
travel: {speed_m_s: 1.0, passes: 2}
ground:
  shear_modulus_mpa: 40
  features:
    - {kind: section, from_m: 3, shear_modulus_mpa: 60}
exciter:
  amplitude_mm: 1.4
  programme:
    - {from_s: 2, amplitude_mm: 1.0}
sensors:
  - name: mems_50g
  - name: tacho
  - name: odometry
  - name: gnss
faults:
  - {id: bias_step, from_s: 1, to_s: 2}
parameters: {meter.period_tolerance: 0.05}
seed: 5
"""


@pytest.fixture(scope="session")
def scenario(tmp_path_factory) -> Path:
    """Return a scenario of 12 s with every kind of sensor."""
    path = tmp_path_factory.mktemp("scenario") / "everything.yaml"
    path.write_text(SCENARIO, encoding="utf-8")
    return path


@pytest.fixture
def short(tmp_path: Path) -> Path:
    """Return a scenario of 3 s, forth and back."""
    path = tmp_path / "short.yaml"
    path.write_text("lane: {length_m: 1.5}\ntravel: {passes: 2}\nseed: 5\n", encoding="utf-8")
    return path


@pytest.fixture(scope="session")
def stepped_sim(scenario, tmp_path_factory) -> Iterator[tuple[int, Sim]]:
    """Return domain and process of a roller in lock step on a scenario."""
    folder = tmp_path_factory.mktemp("stepped_sim")
    with (
        locked_domain() as number,
        Sim(folder, number, "--lock-step", "--scenario", str(scenario)) as sim,
    ):
        yield number, sim


@pytest.fixture(scope="session")
def steady_client(stepped_sim) -> Iterator[Client]:
    with Client(stepped_sim[0]) as client:
        yield client


@pytest.fixture
def stepper(steady_client: Client) -> Iterator[Client]:
    """Return a client of the roller in lock step, which is at its start, and has heard nothing yet."""
    response = steady_client.ask(ResetSimulation, "reset_simulation")
    assert response.result.result == Result.RESULT_OK
    yield steady_client
    steady_client.listen_no_more()


@pytest.fixture
def visitor(resident: Client) -> Iterator[Client]:
    """Return a client of the shared roller that has heard nothing yet."""
    yield resident
    resident.listen_no_more()
