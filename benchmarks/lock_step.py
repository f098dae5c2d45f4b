# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How much faster than real time lock step goes, with DDS, a recording and a client in the loop."""

from __future__ import annotations

import resource
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile

from benchmarks.errors import BenchmarkError
from benchmarks.options import Options
from benchmarks.processes import PATIENCE_S, Process
from benchmarks.table import Table, seconds
from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.msg import CompactionMeter, DrumAcceleration, Result
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.srv import Advance, GetSimulationState

REVOLUTIONS = 2000
SETTLED = 100
HZ = 28.0
DEPTH = 1000

EXECUTORS: dict[str, Callable[[Context], Executor]] = {
    "EventsExecutor": lambda context: EventsExecutor(context=context),
    "SingleThreadedExecutor": lambda context: SingleThreadedExecutor(context=context),
}


@dataclass(frozen=True)
class Cost:
    """Of one revolution, s; NaN where there is no such process."""

    real_s: float
    node_s: float
    client_s: float


class Client:
    """Steps a revolution, waits until it has heard all of it, and steps the next."""

    def __init__(self, number: int, executor: str) -> None:
        self._context = Context()
        rclpy.init(context=self._context, domain_id=number)
        self._node = Node("benchmark_client", context=self._context)
        self._executor = EXECUTORS[executor](self._context)
        self._executor.add_node(self._node)
        self._heard = 0
        self._values = 0
        qos = QoSProfile(depth=DEPTH)
        self._node.create_subscription(DrumAcceleration, "drum/acceleration", self._take, qos)
        self._node.create_subscription(CompactionMeter, "meter", self._take_value, qos)
        self._advance: Any = self._node.create_client(Advance, "advance")
        self._state: Any = self._node.create_client(GetSimulationState, "get_simulation_state")
        self._until(
            lambda: self._advance.service_is_ready() and self._state.service_is_ready(),
            "the node's services",
        )

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()

    def step(self) -> None:
        """Step a revolution and take its samples and its meter value."""
        values = self._values
        response = self._call(self._advance, Advance.Request(revolutions=1))
        if response.result.result != Result.RESULT_OK:
            raise BenchmarkError(f"advance: {response.result.error_message}")
        self._until(
            lambda: self._heard == response.next_sample and self._values > values, "its messages"
        )

    def ask(self) -> None:
        """Call a service that does nothing."""
        self._call(self._state, GetSimulationState.Request())

    def _call(self, client: Any, request: Any) -> Any:
        future = client.call_async(request)
        self._until(future.done, "an answer")
        return future.result()

    def _until(self, done: Callable[[], bool], what: str) -> None:
        deadline = time.monotonic() + PATIENCE_S
        while not done():
            if time.monotonic() > deadline:
                raise BenchmarkError(f"no {what} within {PATIENCE_S:g} s")
            self._executor.spin_once(timeout_sec=0.1)

    def _take(self, block: DrumAcceleration) -> None:
        self._heard = block.sequence + len(block.vertical)

    def _take_value(self, _value: CompactionMeter) -> None:
        self._values += 1


def measure(_options: Options) -> Table:
    """Step whole revolutions in blocks of 128 and 16, and time what a call and a revolution cost without the other."""
    rows = []
    for samples, executor in (
        (128, "EventsExecutor"),
        (128, "SingleThreadedExecutor"),
        (16, "EventsExecutor"),
    ):
        stepped, asked = _stepped(samples, executor)
        name = f"blocks of {samples}, {executor}"
        rows.append(_row(name, stepped))
        rows.append(_row(f"{name}: calls alone", asked, simulated=False))
        alone = _alone(samples)
        rows.append(_row(f"blocks of {samples}, without ROS", alone))
    return Table(
        title="Lock step",
        says=(
            f"`roller-sim sim --lock-step` at {HZ:g} Hz, recording to MCAP, stepped revolution by revolution by a "
            "client in another process, which takes samples and meter value of each before it asks for the next; the "
            "executor is the client's. Beside it the same calls to a service that does nothing, and the same messages "
            f"made without ROS. Per revolution, {REVOLUTIONS} of them. Aim: 30 × real time in blocks of 128."
        ),
        columns=("", "× real time", "real time", "CPU node", "CPU client"),
        rows=rows,
    )


def _stepped(samples: int, executor: str) -> tuple[Cost, Cost]:
    parameters = {
        "pacing.samples_per_message": samples,
        "exciter.frequency_rate_hz_per_s": 1000.0,
    }
    arguments = [word for item in parameters.items() for word in ("-p", "{}:={}".format(*item))]
    with tempfile.TemporaryDirectory() as folder, own_domain() as number:
        trace = str(Path(folder, "trace.mcap"))
        with (
            Process(
                Path(folder),
                number,
                "roller_sim_ros.commands",
                *("sim", "--lock-step", "--record", trace, "--ros-args", *arguments),
            ) as node,
            Client(number, executor) as client,
        ):
            for _ in range(SETTLED):
                client.step()
            return _cost(client.step, node), _cost(client.ask, node)


def _alone(samples: int) -> Cost:
    emulator = Emulator(Configuration(), start_ns=0)

    def step() -> None:
        for _ in range(SAMPLES_PER_REVOLUTION // samples):
            emulator.advance(samples)

    for _ in range(SETTLED):
        step()
    return _cost(step, None)


def _cost(act: Callable[[], None], node: Process | None) -> Cost:
    node_s = node.cpu_seconds()[0] if node else float("nan")
    client_s = _own_cpu_s()
    start = time.perf_counter()
    for _ in range(REVOLUTIONS):
        act()
    return Cost(
        (time.perf_counter() - start) / REVOLUTIONS,
        ((node.cpu_seconds()[0] if node else float("nan")) - node_s) / REVOLUTIONS,
        (_own_cpu_s() - client_s) / REVOLUTIONS,
    )


def _own_cpu_s() -> float:
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def _row(name: str, cost: Cost, *, simulated: bool = True) -> tuple[str, ...]:
    return (
        name,
        f"{1.0 / HZ / cost.real_s:.1f}" if simulated else "",
        seconds(cost.real_s),
        seconds(cost.node_s) if cost.node_s == cost.node_s else "",
        seconds(cost.client_s),
    )
