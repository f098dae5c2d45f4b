# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the commands import, and how long that takes (`python -X importtime`)."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path
from statistics import median

from benchmarks.errors import BenchmarkError
from benchmarks.options import Options
from benchmarks.processes import PATIENCE_S, environment
from benchmarks.table import Table, seconds
from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.commands import COMMANDS

ROUNDS = 5
HEAVIEST = 10
HELP = ("", *COMMANDS)

_LINE = re.compile(r"^import time:\s+(\d+) \|\s+\d+ \| +(\S+)$", re.MULTILINE)

Times = dict[str, float]
"""Seconds by top-level package, of the modules' own code."""


def measure(options: Options) -> Table:
    """Import what `sim` and `run` really import, several times in turn."""
    rounds = options.rounds(ROUNDS)
    sims: list[Times] = []
    runs: list[Times] = []
    helps: dict[str, list[float]] = {command: [] for command in HELP}
    with tempfile.TemporaryDirectory() as name, own_domain() as number:
        folder = Path(name)
        for _ in range(rounds):
            sims.append(_imports(folder, number, "sim", ends=False))
            runs.append(_imports(folder, number, "run", "--revolutions", "2"))
            for command, times in helps.items():
                times.append(_help(command))
    sim, run = _medians(sims), _medians(runs)
    most = {name: max(sim.get(name, 0.0), run.get(name, 0.0)) for name in sim | run}
    heaviest = sorted(most, key=lambda name: -most[name])[:HEAVIEST]
    rows = [("all", seconds(sum(sim.values())), seconds(sum(run.values())))]
    rows += [(name, _time(sim.get(name)), _time(run.get(name))) for name in heaviest]
    return Table(
        title="Imports",
        says=(
            "Time that `roller-sim sim` and `roller-sim run` spend importing until the first status "
            "line and the end, by the package whose code runs, without what that imports in turn; the "
            f"{HEAVIEST} heaviest. Medians of {rounds}; tracing makes imports slower."
        ),
        columns=("package", "sim", "run"),
        rows=[*rows],
        notes=[
            "Whole time of `--help`: "
            + ", ".join(
                f"{f'roller-sim {command}'.strip()} {seconds(median(times))}"
                for command, times in helps.items()
            )
            + "."
        ],
    )


def _imports(folder: Path, number: int, command: str, *arguments: str, ends: bool = True) -> Times:
    errors = folder / "importtime"
    with errors.open("wb") as stream:
        process = subprocess.Popen(
            [
                sys.executable,
                "-X",
                "importtime",
                "-m",
                "roller_sim_ros.commands",
                command,
                *arguments,
            ],
            stdout=subprocess.PIPE,
            stderr=stream,
            env=environment(folder, number),
            text=True,
        )
        assert process.stdout is not None  # a pipe
        if not ends:
            process.stdout.readline()
            process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE_S)
    text = errors.read_text(encoding="utf-8")
    if process.returncode:
        raise BenchmarkError(f"roller-sim {command}: exit code {process.returncode}\n{text[-500:]}")
    found: Times = defaultdict(float)
    for microseconds, module in _LINE.findall(text):
        found[module.partition(".")[0]] += int(microseconds) * 1e-6
    return found


def _help(command: str) -> float:
    arguments = [command, "--help"] if command else ["--help"]
    start = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "roller_sim_ros.commands", *arguments],
        stdout=subprocess.DEVNULL,
        check=True,
    )
    return time.perf_counter() - start


def _medians(found: list[Times]) -> Times:
    names = set().union(*found)
    return {name: median(times.get(name, 0.0) for times in found) for name in names}


def _time(value: float | None) -> str:
    return seconds(value) if value else "–"
