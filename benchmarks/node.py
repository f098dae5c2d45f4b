# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The real node: lateness of its blocks beside a bare deadline loop, share of a core, lost samples."""

from __future__ import annotations

import re
import tempfile
import time
from pathlib import Path

from benchmarks.errors import BenchmarkError
from benchmarks.options import Options
from benchmarks.percentiles import SHARES
from benchmarks.processes import TOPIC, Process, sim
from benchmarks.table import Table
from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration

FREQUENCIES_HZ = (28.0, 40.0)
BUSY_S = 0.4e-3
"""CPU time of the busy loop per block: about the node's."""
SETTLING_S = 5.0
"""Run-up of the exciter and discovery, before CPU time is counted."""

_SUMMARY = re.compile(
    r"ran (?P<ran>[\d.]+) s: (?P<samples>\d+) samples in (?P<blocks>\d+) blocks, (?P<late>\d+) late; "
    r"lateness p50 (?P<p50>[\d.]+), p99 (?P<p99>[\d.]+), p99.9 (?P<p999>[\d.]+), max (?P<max>[\d.]+) ms"
)
_RECORDED = re.compile(r"recorded .*: (?P<messages>\d+) messages, .* (?P<dropped>\d+) dropped")


def measure(options: Options) -> Table:
    """Run the node at both frequencies, then for long."""
    rows: list[tuple[str, ...]] = []
    with tempfile.TemporaryDirectory() as name, own_domain() as number:
        folder = Path(name)
        lengths = [(frequency, options.seconds) for frequency in FREQUENCIES_HZ]
        lengths.append((FREQUENCIES_HZ[-1], 60.0 * options.minutes))
        for frequency_hz, length_s in lengths:
            rows += _run(folder, number, frequency_hz, length_s)
    return Table(
        title="Node",
        says=(
            "`roller-sim sim` in a process of its own, recording, with a subscriber in another process. "
            "At the same time a bare deadline loop of the same period in a third, and one that is busy "
            f"for {BUSY_S * 1e3:g} ms of CPU time before each deadline, about as the node is, in a "
            "fourth. Lateness as the node states it at its end, of all blocks since its start, in ms; "
            "CPU time as a share of one core, of the node and of its recording process; samples lost at "
            "the subscriber and messages dropped by the recording. Aims: p99.9 under one block, a node "
            "under 15 % of a core at 40 Hz, nothing lost."
        ),
        columns=("run", *SHARES, "late", "core", "recorder", "samples", "lost", "dropped"),
        rows=rows,
    )


def _run(folder: Path, number: int, frequency_hz: float, length_s: float) -> list[tuple[str, ...]]:
    block = Configuration().pacing.samples_per_message
    period_s = block / (SAMPLES_PER_REVOLUTION * frequency_hz)
    trace = folder / f"{frequency_hz:g}-{length_s:g}.mcap"
    with Process(folder, number, "benchmarks.subscriber", TOPIC) as subscriber:
        subscriber.await_line("ready")
        with (
            _loop(folder, number, period_s, 0.0) as bare,
            _loop(folder, number, period_s, BUSY_S) as busy,
            sim(folder, number, frequency_hz, trace) as node,
        ):
            subscriber.await_line("first")
            time.sleep(SETTLING_S)
            before, then = node.cpu_seconds(), time.monotonic()
            time.sleep(max(0.0, length_s - SETTLING_S))
            after, now = node.cpu_seconds(), time.monotonic()
            loops = {"bare loop": bare.result(), "busy loop": busy.result()}
            said = node.end()
        found = subscriber.result()
    trace.unlink()
    summary, recorded = _SUMMARY.search(said), _RECORDED.search(said)
    if summary is None or recorded is None:
        raise BenchmarkError(f"the node's last lines are not as expected: {said[-400:]}")
    own, recorder = (100.0 * (b - a) / (now - then) for a, b in zip(before, after, strict=True))
    what = f"{frequency_hz:g} Hz, {length_s:g} s, block {period_s * 1e3:.2f} ms"
    return [
        (
            f"{what}: node",
            *(f"{float(summary[key]):.2f}" for key in ("p50", "p99", "p999", "max")),
            summary["late"],
            f"{own:.1f} %",
            f"{recorder:.1f} %",
            str(found["samples"]),
            str(found["lost"]),
            recorded["dropped"],
        ),
        *(
            (
                f"{what}: {loop}",
                *(f"{plain[share] * 1e3:.2f}" for share in SHARES),
                str(plain["late"]),
                *("" for _ in range(5)),
            )
            for loop, plain in loops.items()
        ),
    ]


def _loop(folder: Path, number: int, period_s: float, busy_s: float) -> Process:
    return Process(folder, number, "benchmarks.bare_loop", f"{period_s!r}", f"{busy_s!r}")
