# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Fixtures: a roller, its panel and a browser, which the tests share; each test has a page of its own."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect, sync_playwright

from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.report.pdf import find_browser
from tests.integration.harness import PATIENCE_S, Client, Sim

QUICK = ("--ros-args", "-p", "exciter.frequency_rate_hz_per_s:=100.0")


class Panel:
    """``roller-sim panel`` in a process of its own, on a port that is free."""

    def __init__(self, folder: Path, number: int, *arguments: str) -> None:
        self._output = folder / f"{time.monotonic_ns()}.panel"
        with self._output.open("wb") as output:
            self.process = subprocess.Popen(
                [
                    sys.executable,
                    "-m",
                    "roller_sim_ros.commands",
                    "panel",
                    "--port",
                    "0",
                    *arguments,
                ],
                stdout=output,
                stderr=subprocess.STDOUT,
                cwd=folder,
                env={**os.environ, "ROS_DOMAIN_ID": str(number), "ROS_LOG_DIR": str(folder)},
                start_new_session=True,
            )

    def __enter__(self) -> Panel:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.terminate()
        try:
            self.process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    @property
    def said(self) -> str:
        return self._output.read_text(encoding="utf-8")

    def url(self) -> str:
        """Its address, once it has said it."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline and self.process.poll() is None:
            found = re.search(r"panel: (http://\S+) ", self.said)
            if found:
                return found[1]
            time.sleep(0.05)
        raise AssertionError(self.said)


@pytest.fixture(scope="session")
def number() -> Iterator[int]:
    with own_domain() as found:
        yield found


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("panel")


@pytest.fixture(scope="session")
def panel(number: int, folder: Path) -> Iterator[Panel]:
    with Panel(folder, number) as running:
        yield running


class Roller:
    """The roller that the tests share; it can be gone and come back."""

    def __init__(self, folder: Path, number: int) -> None:
        self.folder = folder
        self._number = number
        self.start()

    def start(self) -> None:
        self._sim = Sim(self.folder, self._number, *QUICK)

    def end(self) -> None:
        assert self._sim.end() == 0, self._sim.complaints


@pytest.fixture(scope="session")
def roller(number: int, folder: Path) -> Iterator[Roller]:
    running = Roller(folder, number)
    yield running
    running.end()


@pytest.fixture(scope="session")
def client(number: int) -> Iterator[Client]:
    with Client(number) as running:
        yield running


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=find_browser(), args=["--no-sandbox"])
        yield running
        running.close()


@pytest.fixture
def page(browser: Browser, panel: Panel, roller: Roller) -> Iterator[Page]:  # noqa: ARG001
    """A page that is connected; a script that fails on it fails the test."""
    expect.set_options(timeout=1e3 * PATIENCE_S)
    context = browser.new_context(viewport={"width": 1440, "height": 1000})
    context.set_default_timeout(1e3 * PATIENCE_S)
    opened = context.new_page()
    failures: list[str] = []
    opened.on("pageerror", lambda error: failures.append(str(error)))
    opened.goto(panel.url())
    yield opened
    context.close()
    assert failures == []
