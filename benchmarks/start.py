# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How long it takes from the start of the node to its first sample."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from statistics import median

from benchmarks.options import Options
from benchmarks.processes import TOPIC, Process, sim
from benchmarks.table import Table, seconds
from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.traces.reader import TraceReader

STARTS = 9
FREQUENCY_HZ = 28.0
LISTENING_S = 0.5
"""How long the subscriber is there before the publisher starts."""


def measure(options: Options) -> Table:
    """Start the node and a plain publisher in turn."""
    published, heard, used, plain = [], [], [], []
    starts = options.rounds(STARTS)
    with tempfile.TemporaryDirectory() as name, own_domain() as number:
        folder = Path(name)
        _start(folder, number)  # compiles what the disk does not hold yet
        for _ in range(starts):
            first, second, cpu = _start(folder, number)
            published.append(first)
            heard.append(second)
            used.append(cpu)
            plain.append(_plain(folder, number))
    return Table(
        title="Start",
        says=(
            "From the start of the process, caches warm, to the first block: when `roller-sim sim` "
            f"published it (by its recording) and when a subscriber that was there {LISTENING_S:g} s "
            f"before got the first one; beside a plain rclpy publisher of the same message. {starts} "
            "starts of each in turn. What lies between published and heard, up to 3 s, is Fast DDS "
            "discovery, which also the plain publisher waits for."
        ),
        columns=("what", "median", "fastest", "slowest", "aim"),
        rows=[
            _row("roller-sim sim, published", published, "< 3 s"),
            _row("roller-sim sim, heard", heard, ""),
            _row("roller-sim sim, CPU time until heard", used, ""),
            _row("plain publisher, heard", plain, ""),
        ],
    )


def _row(what: str, times: list[float], aim: str) -> tuple[str, ...]:
    return (what, seconds(median(times)), seconds(min(times)), seconds(max(times)), aim)


def _start(folder: Path, number: int) -> tuple[float, float, float]:
    """Return after how many seconds the node's first block was published and heard, and the CPU time."""
    trace = folder / "start.mcap"
    with Process(folder, number, "benchmarks.subscriber", TOPIC) as subscriber:
        subscriber.await_line("ready")
        time.sleep(LISTENING_S)
        with sim(folder, number, FREQUENCY_HZ, trace) as node:
            subscriber.await_line("first")
            cpu_s, _ = node.cpu_seconds()
            node.end()
        heard_ns = int(subscriber.result()["first_ns"])
    first = next(iter(TraceReader(trace).messages([f"/{TOPIC}"])))
    trace.unlink()
    return (
        (first.publish_time_ns - node.started_ns) * 1e-9,
        (heard_ns - node.started_ns) * 1e-9,
        cpu_s,
    )


def _plain(folder: Path, number: int) -> float:
    with Process(folder, number, "benchmarks.subscriber", TOPIC) as subscriber:
        subscriber.await_line("ready")
        time.sleep(LISTENING_S)
        with Process(folder, number, "benchmarks.plain_publisher", TOPIC) as publisher:
            subscriber.await_line("first")
            publisher.end()
        heard_ns = int(subscriber.result()["first_ns"])
    return (heard_ns - publisher.started_ns) * 1e-9
