# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Processes of a bench end with all that they started, and tell what they said."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import pytest

from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.processes import Process

PATIENCE_S = 30.0


def gone(pid: int) -> bool:
    """Whether a process is not there any more, or only waits to be collected."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return True
    return state in "ZX"


def test_a_process_ends_with_those_that_it_started(tmp_path: Path) -> None:
    child = tmp_path / "child"
    # A shell that does not hand signals on.
    script = f"sleep 600 & echo $! > {child}; trap '' INT; wait"
    process = Process("meter", ["sh", "-c", script], tmp_path / "log", {})
    deadline = time.monotonic() + PATIENCE_S
    while not (child.is_file() and child.read_text(encoding="ascii").strip()):
        assert time.monotonic() < deadline
        time.sleep(0.01)
    process.end()
    assert process.code is not None
    pid = int(child.read_text(encoding="ascii"))
    while not gone(pid):
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_it_tells_its_last_lines_and_its_code(tmp_path: Path) -> None:
    program = "import os; print(*range(9), sep='\\n'); print(os.environ['ROS_DOMAIN_ID']); raise SystemExit(3)"
    process = Process(
        "meter", [sys.executable, "-c", program], tmp_path / "log", {"ROS_DOMAIN_ID": "77"}
    )
    assert process.wait(PATIENCE_S) == 3
    assert process.said() == f"{tmp_path / 'log'}: 5 | 6 | 7 | 8 | 77"
    silent = Process("meter", ["true"], tmp_path / "silent", {})
    assert silent.wait(PATIENCE_S) == 0
    assert silent.said().endswith("(it said nothing)")
    silent.end()


def test_what_cannot_be_started_is_told(tmp_path: Path) -> None:
    with pytest.raises(
        RollerSimError, match="the meter cannot be started: /no/meter: No such file"
    ):
        Process("meter", ["/no/meter"], tmp_path / "log", {})


def test_domains_are_one_s_own() -> None:
    with own_domain() as one, own_domain() as other:
        assert one != other
    asked: list[int] = []

    def occupied(number: int) -> bool:
        asked.append(number)
        return len(asked) < 3

    with own_domain(occupied) as free:
        assert free == asked[-1]
        assert len(set(asked)) == 3
