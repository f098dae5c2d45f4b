"""Fixtures: a domain of one's own, and one roller that the tests which leave it as it was may share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack

import pytest

from tests.integration.harness import Client, Sim, domain


@pytest.fixture
def own_domain() -> Iterator[int]:
    with domain() as number:
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
    with domain() as number:
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


@pytest.fixture
def visitor(resident: Client) -> Iterator[Client]:
    """Return a client of the shared roller that has heard nothing yet."""
    yield resident
    resident.listen_no_more()
