# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Processes that a benchmark starts, on a ROS domain of their own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from benchmarks.errors import BenchmarkError

TOPIC = "drum/acceleration"
PATIENCE_S = 60.0
"""Also enough to compile the kernels."""

_ROOT = Path(__file__).resolve().parents[1]
_CLOCK_TICKS = os.sysconf("SC_CLK_TCK")


def environment(folder: Path, number: int) -> dict[str, str]:
    """Return the environment of a process on a ROS domain, with its logs in a folder."""
    return {
        **os.environ,
        "ROS_DOMAIN_ID": str(number),
        "ROS_LOG_DIR": str(folder),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }


class Process:
    """A Python module run in a process of its own, its output kept in a file.

    Parameters
    ----------
    folder : Path
        Where output and logs go.
    number : int
        ROS domain.
    module, arguments : str
        As for ``python -m``.
    """

    def __init__(self, folder: Path, number: int, module: str, *arguments: str) -> None:
        self.name = " ".join((module, *arguments))
        self._output = folder / f"{module}-{time.monotonic_ns()}.out"
        self._errors = self._output.with_suffix(".err")
        self.started_ns = time.time_ns()
        with self._output.open("wb") as output, self._errors.open("wb") as errors:
            self._process = subprocess.Popen(
                [sys.executable, "-m", module, *arguments],
                stdout=output,
                stderr=errors,
                cwd=_ROOT,
                env=environment(folder, number),
                start_new_session=True,
            )

    def __enter__(self) -> Process:
        return self

    def __exit__(self, *_: object) -> None:
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()

    def await_line(self, start: str) -> str:
        """Wait until it has said a line that begins like this, and return that line."""
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            for line in self.said().splitlines(keepends=True):
                if line.startswith(start) and line.endswith("\n"):
                    return line.strip()
            if self._process.poll() is not None:
                break
            time.sleep(0.02)
        raise BenchmarkError(f"{self.name}: did not say {start!r}\n{self._complaints()}")

    def end(self) -> str:
        """Interrupt it and return all that it said."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        try:
            code = self._process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired as error:
            raise BenchmarkError(f"{self.name}: did not end") from error
        if code:
            raise BenchmarkError(f"{self.name}: exit code {code}\n{self._complaints()}")
        return self.said()

    def result(self) -> dict[str, Any]:
        """End it and return the JSON object that is its last line."""
        found: dict[str, Any] = json.loads(self.end().splitlines()[-1])
        return found

    def said(self) -> str:
        """Return its standard output so far."""
        return self._output.read_text(encoding="utf-8")

    def cpu_seconds(self) -> tuple[float, float]:
        """Return the CPU time used so far, its own and that of its children."""
        own = _cpu_seconds(self._process.pid)
        tasks = Path(f"/proc/{self._process.pid}/task")
        children = {
            int(pid)
            for task in tasks.iterdir()
            for pid in (task / "children").read_text(encoding="ascii").split()
        }
        return own, sum(_cpu_seconds(pid) for pid in children)

    def _complaints(self) -> str:
        return self._errors.read_text(encoding="utf-8")[-2000:]


def sim(folder: Path, number: int, frequency_hz: float, trace: Path) -> Process:
    """Start ``roller-sim sim``, recording."""
    arguments = ("sim", "--frequency-hz", f"{frequency_hz:g}", "--record", str(trace))
    return Process(folder, number, "roller_sim_ros.commands", *arguments)


def _cpu_seconds(pid: int) -> float:
    try:
        text = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
    except OSError:
        return 0.0
    # The name, in parentheses, may hold spaces.
    fields = text.rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _CLOCK_TICKS
