# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Runs a scenario with a meter under test beside it; what is left is a trace to be judged."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.processes import Process

if TYPE_CHECKING:
    from roller_sim_ros.node.bench_client import BenchClient

PATIENCE_S = 60.0
"""How long roller and meter may take to be there, and a step to end: the kernels may have to be compiled."""

BUILT_IN = "meter"
"""Topic of the roller's own meter, judged where there is no other."""


class BenchError(RollerSimError):
    """A bench did not come to a trace that could be judged."""


@dataclass(frozen=True)
class Bench:
    """What is run.

    Attributes
    ----------
    scenario : str
        File or name of the scenario.
    meter : tuple of str
        Program and arguments of the meter under test; empty: the roller's own meter is judged.
    topic : str
        The meter's; empty: the only one that it publishes.
    folder : Path
        Where trace and logs go.
    clock : str
        ``lock-step``, ``sim`` or ``real``.
    speed : float
        Simulated over real time, with ``sim``.
    domain : int
        ROS domain.
    samples_per_message : int or None
        Size of the roller's blocks; None: as the scenario has it.
    """

    scenario: str
    meter: tuple[str, ...]
    topic: str
    folder: Path
    clock: str
    speed: float
    domain: int
    samples_per_message: int | None = None


@dataclass(frozen=True)
class Ran:
    """What came of a bench.

    Attributes
    ----------
    trace : Path
        The trace.
    topic : str
        The meter's.
    meter_ended : str
        How the meter ended before the scenario did; empty: it did not.
    """

    trace: Path
    topic: str
    meter_ended: str


def run_bench(bench: Bench) -> Ran:
    """Run a scenario to its end and return where its trace is.

    Raises
    ------
    RollerSimError
        If roller or meter cannot be started, are not heard of, or the roller ends too early.
    """
    from roller_sim_ros.node.bench_client import BenchClient

    trace = _prepared(bench.folder)
    with ExitStack() as stack:
        client = stack.enter_context(BenchClient(bench.domain))

        def start(name: str, command: list[str]) -> Process:
            log = bench.folder / f"{name}.log"
            process = Process(name, command, log, {"ROS_DOMAIN_ID": str(bench.domain)})
            stack.callback(process.end)
            return process

        meter = start("meter", list(bench.meter)) if bench.meter else None
        topic, type_name = _topic(bench, client, meter)
        roller = start("roller", _roller_command(bench, topic, trace))
        _follow(bench, client, meter, roller, topic, type_name)
        ended = (
            f"the meter ended with {meter.code}; {meter.said()}"
            if meter and meter.code is not None
            else ""
        )
        if roller.wait(PATIENCE_S) != 0:
            raise BenchError(f"the roller ended with {roller.code}; {roller.said()}")
    return Ran(trace, topic, ended)


def _prepared(folder: Path) -> Path:
    """Make the folder and return the trace's place in it, free of what an earlier bench left."""
    trace = folder / "trace.mcap"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with suppress(FileNotFoundError):
            trace.unlink()
    except OSError as error:
        raise BenchError(f"{folder}: cannot be written: {error.strerror or error}") from None
    return trace


def _roller_command(bench: Bench, topic: str, trace: Path) -> list[str]:
    command = [sys.executable, "-m", "roller_sim_ros.commands", "sim", "--exit-at-end"]
    command += ["--scenario", bench.scenario, "--record", str(trace)]
    if bench.meter:
        command += ["--record-topic", topic]
    if bench.clock == "lock-step":
        command += ["--lock-step"]
    else:
        command += ["--clock", bench.clock]
    if bench.clock == "sim":
        command += ["--speed", str(bench.speed)]
    if bench.samples_per_message is not None:
        samples = f"pacing.samples_per_message:={bench.samples_per_message}"
        command += ["--ros-args", "-p", samples]
    return command


def _topic(bench: Bench, client: BenchClient, meter: Process | None) -> tuple[str, str]:
    """Return the meter's topic and its type, once it is there."""
    if meter is None:
        return client.resolved(bench.topic or BUILT_IN), ""
    wanted = client.resolved(bench.topic) if bench.topic else ""

    def there() -> dict[str, str]:
        found = client.meter_topics()
        return {name: kind for name, kind in found.items() if wanted in ("", name)}

    found = client.wait_for(there, _runs(meter), PATIENCE_S)
    if meter.code is not None:
        raise BenchError(f"the meter ended with {meter.code}; {meter.said()}")
    if not found:
        other = ", ".join(client.meter_topics())
        raise BenchError(
            f"the meter does not publish {wanted or 'anything'}{other and f', but {other}'}; {meter.said()}"
        )
    if len(found) > 1:
        raise BenchError(
            f"the meter publishes several topics; choose one with --topic: {', '.join(sorted(found))}"
        )
    ((name, type_name),) = found.items()
    return name, type_name


def _follow(
    bench: Bench,
    client: BenchClient,
    meter: Process | None,
    roller: Process,
    topic: str,
    type_name: str,
) -> None:
    """Let the scenario run to its end."""
    runs = _runs(roller)
    if bench.clock != "lock-step":
        roller.wait()
        return
    if type_name:
        client.follow(topic, type_name)

    def ready() -> bool:
        heard = meter is None or client.listens() or meter.code is not None
        return client.steppable() and client.recorded(topic) and heard

    if not client.wait_for(ready, runs, PATIENCE_S):
        if roller.code is not None:
            raise BenchError(f"the roller ended with {roller.code}; {roller.said()}")
        if not client.steppable():
            raise BenchError(f"the roller is not there after {PATIENCE_S:g} s; {roller.said()}")
        raise BenchError(
            f"nobody listens to drum/acceleration after {PATIENCE_S:g} s: the meter has to"
        )
    client.run(runs, lambda: meter is not None and meter.code is None, PATIENCE_S)


def _runs(process: Process) -> Callable[[], bool]:
    return lambda: process.code is None
