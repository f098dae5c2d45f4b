# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Processes that are started for something, and ended with all that they started themselves."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from roller_sim_ros.errors import RollerSimError

GRACE_S = 5.0
"""How long a process has after SIGINT, and again after SIGTERM, before it is killed."""

TAIL_LINES = 5


class Process:
    """A process whose output goes to a file.

    Parameters
    ----------
    name : str
        What it is, for messages.
    command : sequence of str
        Program and arguments.
    log : Path
        Where its output goes.
    environment : mapping
        What differs from the environment of this process.
    folder : Path, optional
        Where it works; where this process does when not given.

    Raises
    ------
    RollerSimError
        If it cannot be started.
    """

    def __init__(
        self,
        name: str,
        command: Sequence[str],
        log: Path,
        environment: Mapping[str, str],
        folder: Path | None = None,
    ) -> None:
        self.name = name
        self.log = log
        try:
            with log.open("wb") as output:
                self._process = subprocess.Popen(
                    command,
                    cwd=folder,
                    stdin=subprocess.DEVNULL,
                    stdout=output,
                    stderr=subprocess.STDOUT,
                    env={**os.environ, **environment},
                    # A group of its own, to end it with all that it starts (a shell, ros2 run).
                    start_new_session=True,
                )
        except OSError as error:
            raise RollerSimError(
                f"the {name} cannot be started: {command[0]}: {error.strerror or error}"
            ) from None

    @property
    def pid(self) -> int:
        """Its number."""
        return self._process.pid

    @property
    def code(self) -> int | None:
        """Exit code; None while it runs."""
        return self._process.poll()

    def wait(self, timeout_s: float | None = None) -> int | None:
        """Return the exit code as soon as it has ended, None when it has not within that time."""
        try:
            return self._process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            return None

    def end(self) -> None:
        """End it and whatever it started, gently if it lets itself."""
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            if self.code is None:
                self._signal(number)
                self.wait(GRACE_S)
        # What outlived its parent.
        self._signal(signal.SIGKILL)

    def said(self) -> str:
        """Return where its output is, and its last lines."""
        lines = self.log.read_text(encoding="utf-8", errors="replace").splitlines()
        tail = " | ".join(line for line in lines[-TAIL_LINES:] if line.strip())
        return f"{self.log}" + (f": {tail}" if tail else " (it said nothing)")

    def _signal(self, number: signal.Signals) -> None:
        try:
            os.killpg(self._process.pid, number)
        except ProcessLookupError:
            return
