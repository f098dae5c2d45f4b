# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The live page beside the node: lateness of the node's blocks without and with it, frames drawn, and its cost."""

from __future__ import annotations

import re
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from benchmarks.errors import BenchmarkError
from benchmarks.options import Options
from benchmarks.percentiles import SHARES
from benchmarks.processes import Process
from benchmarks.table import Table
from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.report.pdf import find_browser

HZ = 40.0
SETTLING_S = 8.0
"""Run-up of the exciter, and the page's map of modes."""
LONGEST_S = 60.0
BLOCK_S = Configuration().pacing.samples_per_message / (SAMPLES_PER_REVOLUTION * HZ)
RUNS = ALONE, SERVED, SHOWN = ("node alone", "with the panel", "with panel and browser")

DRAWN = "Number(document.getElementById('rate').dataset.drawn || 0)"
_SUMMARY = re.compile(
    r"in (?P<blocks>\d+) blocks, (?P<late>\d+) late; "
    r"lateness p50 (?P<p50>[\d.]+), p99 (?P<p99>[\d.]+), p99.9 (?P<p999>[\d.]+), max (?P<max>[\d.]+) ms"
)


def measure(options: Options) -> Table:
    """Run the node alone, with the page's server, and with a browser that shows the page."""
    length_s = min(options.seconds, LONGEST_S)
    with tempfile.TemporaryDirectory() as name, own_domain() as number:
        rows = [_run(Path(name), number, what, length_s) for what in RUNS]
    return Table(
        title="Live page",
        says=(
            f"`roller-sim sim` at {HZ:g} Hz for {length_s:g} s, alone, with `roller-sim panel`, and with a headless "
            "Chromium on the same machine that shows the page; it draws without a graphics card, on the node's cores. "
            "Lateness of the node's blocks as it states it, in ms, and p99.9 of a bare deadline loop of the same "
            "period in another process at the same time; CPU time of node and panel as a share of one core; frames "
            f"that the page drew. Aims: p99.9 under one block, {1e3 * BLOCK_S:.2f} ms; 20 frames a second."
        ),
        columns=("run", *SHARES, "late", "bare loop p99.9", "node", "panel", "frames/s"),
        rows=rows,
    )


def _run(folder: Path, number: int, what: str, length_s: float) -> tuple[str, ...]:
    module = "roller_sim_ros.commands"
    with ExitStack() as stack:
        panel, page = None, None
        if what != ALONE:
            panel = stack.enter_context(Process(folder, number, module, "panel", "--port", "0"))
            url = panel.await_line("panel: ").split()[1]
            if what == SHOWN:
                page = stack.enter_context(_opened(url))
        # Last, so that its blocks do not see the others start.
        arguments = ("sim", "--frequency-hz", f"{HZ:g}")
        node = stack.enter_context(Process(folder, number, module, *arguments))
        loop = stack.enter_context(
            Process(folder, number, "benchmarks.bare_loop", f"{BLOCK_S!r}", "0.0")
        )
        processes = [node] if panel is None else [node, panel]
        time.sleep(SETTLING_S)
        before, then = [process.cpu_seconds()[0] for process in processes], time.monotonic()
        drawn = page.evaluate(DRAWN) if page else 0
        time.sleep(max(0.0, length_s - SETTLING_S))
        after, took_s = [process.cpu_seconds()[0] for process in processes], time.monotonic() - then
        frames = f"{(page.evaluate(DRAWN) - drawn) / took_s:.1f}" if page else ""
        bare = loop.result()
        said = node.end()
    summary = _SUMMARY.search(said)
    if summary is None:
        raise BenchmarkError(f"the node's last line is not as expected: {said[-400:]}")
    shares = [f"{100.0 * (b - a) / took_s:.1f} %" for a, b in zip(before, after, strict=True)]
    return (
        what,
        *(f"{float(summary[key]):.2f}" for key in ("p50", "p99", "p999", "max")),
        summary["late"],
        f"{1e3 * bare['p99.9']:.2f}",
        shares[0],
        shares[1] if panel else "",
        frames,
    )


@contextmanager
def _opened(url: str) -> Iterator[Any]:
    """Yield the page in a browser."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=find_browser(), args=["--no-sandbox"])
        page = running.new_page(viewport={"width": 1440, "height": 1000})
        page.goto(url)
        yield page
        running.close()
