# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What demo.launch.py starts runs: roller and page, in a namespace, with parameters, recorded."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from urllib.request import urlopen

from roller_sim_ros.traces.reader import TraceReader
from tests.integration.harness import PATIENCE_S, recorded
from tests.launching import ROOT, launched

STARTING_S = 5 * PATIENCE_S
"""What is installed may be another copy than that of the other tests, whose kernels are compiled."""


def until(found: Callable[[], re.Match[str] | None]) -> re.Match[str]:
    """Wait until something is said."""
    end = time.monotonic() + STARTING_S
    while time.monotonic() < end:
        match = found()
        if match is not None:
            return match
        time.sleep(0.05)
    raise AssertionError("nothing was said")


def test_demo_starts_roller_and_page(own_domain: int, tmp_path: Path) -> None:
    processes = launched(
        "demo",
        tmp_path,
        namespace="roller_1",
        params_file=str(ROOT / "config" / "dense.yaml"),
        record="trace.mcap",
        use_sim_time="true",
        port="0",
    )
    environment = {
        **os.environ,
        "ROS_DOMAIN_ID": str(own_domain),
        "ROS_LOG_DIR": str(tmp_path),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    with ExitStack() as stack:
        started = []
        for number, item in enumerate(processes):
            with (tmp_path / f"{number}.out").open("wb") as output:
                process = subprocess.Popen(
                    item.command,
                    cwd=tmp_path,
                    env=environment,
                    stdout=output,
                    stderr=subprocess.STDOUT,
                    start_new_session=True,
                )
            stack.callback(process.wait)
            stack.callback(process.kill)
            started.append(process)
        roller, page = (tmp_path / f"{number}.out" for number in range(2))
        until(lambda: re.search(r"G +80\.0 MPa", roller.read_text(encoding="utf-8")))
        url = until(lambda: re.search(r"panel: (http\S+)", page.read_text(encoding="utf-8")))
        with urlopen(url[1], timeout=PATIENCE_S) as response:
            assert "<html" in response.read().decode()
        for process in started:
            process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE_S) == 0, (roller.read_text(), page.read_text())
    trace = tmp_path / "trace.mcap"
    topics = {item.topic for item in TraceReader(trace).messages()}
    assert {"/roller_1/drum/acceleration", "/roller_1/meter", "/clock"} <= topics
    assert {item.header.stamp.sec for item in recorded(trace, "/roller_1/meter")} <= set(range(60))
