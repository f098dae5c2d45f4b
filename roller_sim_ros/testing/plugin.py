# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The fixtures, and what pytest has to know for them."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Generator, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from roller_sim_ros.testing.roller import Roller

OPTION = "--roller-traces"
_FAILED = pytest.StashKey[bool]()
_KEPT = pytest.StashKey[list[str]]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option for the place of the traces of failed tests."""
    parser.addoption(
        OPTION,
        metavar="DIR",
        default=None,
        help="copy the roller's trace of each failed test there; else it stays in the test's tmp_path",
    )


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[Any]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Note whether a test failed, for its fixtures."""
    del call
    report = yield
    item.stash[_FAILED] = item.stash.get(_FAILED, False) or report.failed
    return report


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """Say where the traces of failed tests are."""
    for line in config.stash.get(_KEPT, []):
        terminalreporter.write_line(line)


@pytest.fixture
def start_roller(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Callable[..., Roller]]:
    """Start rollers with arguments of ``roller-sim sim``, as in ``start_roller("--scenario", "soft_spot")``."""
    rollers: list[Roller] = []
    with ExitStack() as stack:

        def start(*arguments: str) -> Roller:
            made = Roller(tmp_path / f"roller_{len(rollers) + 1}", *arguments)
            rollers.append(made)
            return stack.enter_context(made)

        yield start
    for made in rollers:
        if not request.node.stash.get(_FAILED, False):
            made.trace.unlink(missing_ok=True)
        elif made.trace.exists():
            kept = _kept(request, made.trace)
            request.config.stash.setdefault(_KEPT, []).append(
                f"{request.node.nodeid}: roller's trace {kept}, logs {made.folder}"
            )


@pytest.fixture
def roller(start_roller: Callable[..., Roller]) -> Roller:
    """Start a roller in lock step: 28 Hz, 1.6 mm, on medium ground, from standstill."""
    return start_roller()


def _kept(request: pytest.FixtureRequest, trace: Path) -> Path:
    """Return where the trace of a failed test is from now on."""
    chosen = request.config.getoption(OPTION, default=None)
    if chosen is None:
        return trace
    folder = Path(chosen)
    folder.mkdir(parents=True, exist_ok=True)
    name = re.sub(r"[^\w.-]+", "_", f"{request.node.nodeid}_{trace.parent.name}")
    return Path(shutil.copy(trace, folder / f"{name}.mcap"))
