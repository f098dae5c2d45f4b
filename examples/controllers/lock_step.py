# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A controller in lock step: the roller stands still until the controller has answered its last revolution.

    python -m examples.controllers.lock_step jump_guard --scenario soft_to_stiff --record guard.mcap

starts roller and controller as processes of their own, steps them to the end of the scenario, and says what came out.
Any node can stand in for the controller that answers each ``meter`` by an ``exciter/command`` with its stamp: then
nothing needs a clock or a sleep, and the same scenario gives the same run every time. Its commands are remapped and
handed on from here, before the next step is asked for: what comes to the roller from one process comes in order, what
comes from two may not.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import rclpy
from geometry_msgs.msg import Twist
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from examples.controllers.measurement import N, nanoseconds
from examples.controllers.offline import jumping
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.msg import (
    CompactionMeter,
    DrumSoilState,
    ExciterCommand,
    ExciterState,
    Result,
    SiteState,
)
from roller_sim_ros.srv import Advance

ROOT = Path(__file__).resolve().parents[2]

PATIENCE_S = 60.0

JOIN_S = 0.5
"""After which the roller takes another step although nobody answered yet, since at first it may not have found the
controller; twice as long after each such step, so that a slow controller misses little."""

RELAY = "controller"
"""Namespace in which the controller's commands are heard; `REMAPPED` are the arguments that make a node speak there."""

REMAPPED = ("-r", f"exciter/command:={RELAY}/exciter/command", "-r", f"cmd_vel:={RELAY}/cmd_vel")

CONTROLLERS = ("jump_guard", "phase_tracker", "force_limiter", "model_based")


@dataclass(frozen=True)
class Run:
    """What came of a run.

    Attributes
    ----------
    commands : list of ExciterCommand
        The controller's answers.
    true_rmv, true_mode : ndarray, shape (revolutions,)
        Of each revolution.
    unheard : int
        Steps at whose beginning no command took effect though one was given: it was refused, lost by a fault, or came
        too late.
    """

    commands: list[Any]
    true_rmv: np.ndarray[Any, np.dtype[np.float64]]
    true_mode: np.ndarray[Any, np.dtype[np.int64]]
    unheard: int


class LockStep:
    """Steps a roller, and waits for its controller.

    Parameters
    ----------
    domain : int, optional
        ROS domain; as the environment has it when not given.
    namespace : str
        Of roller and controller.
    patience_s : float
        How long anything may take, in real time, before the run is given up.
    """

    def __init__(
        self, domain: int | None = None, namespace: str = "", patience_s: float = PATIENCE_S
    ) -> None:
        self._patience_s = patience_s
        self._join_s = JOIN_S
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self._node = Node("lock_step", context=self._context, namespace=namespace)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._commands: list[Any] = []
        self._truth: dict[int, tuple[float, int]] = {}
        self._truth_until = 0
        self._site: Any = None
        self._applied: set[int] = set()
        self._asked_ns = -1
        self._answered_ns = -1
        for message, topic, take in (
            (CompactionMeter, "meter", self._on_meter),
            (SiteState, "site/state", self._on_site),
            (DrumSoilState, "truth", self._on_truth),
            (ExciterState, "exciter/state", lambda it: self._applied.add(it.applied_sample)),
        ):
            self._node.create_subscription(message, topic, take, 1000)
        self._speeds = self._node.create_publisher(Twist, "cmd_vel", 10)
        self._exciter = self._node.create_publisher(ExciterCommand, "exciter/command", 10)
        self._node.create_subscription(Twist, f"{RELAY}/cmd_vel", self._speeds.publish, 100)
        self._answers = self._node.create_subscription(
            ExciterCommand, f"{RELAY}/exciter/command", self._on_command, 100
        )
        self._client: Any = self._node.create_client(Advance, "advance")

    def __enter__(self) -> LockStep:
        return self

    def __exit__(self, *_: object) -> None:
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()

    def drive(self, most_revolutions: int = sys.maxsize, revolutions_per_step: int = 1) -> Run:
        """Step until all is driven and return what came out.

        Parameters
        ----------
        most_revolutions : int
            After which the run is cut short.
        revolutions_per_step : int
            How many the roller takes before the controller may answer.

        Raises
        ------
        RollerSimError
            If the roller refuses to step, or somebody does not answer.
        """
        self._until(self._client.service_is_ready, "a roller in lock step")
        for publisher in (self._speeds, self._exciter):
            self._until(publisher.get_subscription_count, "a roller that listens")
        self._until(self._answers.get_publisher_count, "a controller")
        done, next_sample = 0, 0
        told: list[int] = []
        while done < most_revolutions and not self._arrived():
            if self._commands:
                told.append(next_sample)
            revolutions = min(revolutions_per_step, most_revolutions - done)
            next_sample = self._advance(revolutions)
            done += revolutions
            self._until(partial(self._told_until, next_sample), "site/state and truth")
            self._until_answered()
        self._within(lambda: not told or told[-1] in self._applied, JOIN_S)
        truth = [self._truth[index] for index in sorted(self._truth)]
        return Run(
            self._commands,
            np.array([rmv for rmv, _ in truth]),
            np.array([mode for _, mode in truth]),
            sum(sample not in self._applied for sample in told),
        )

    def _on_meter(self, meter: Any) -> None:
        self._asked_ns = max(self._asked_ns, nanoseconds(meter.header.stamp))

    def _on_command(self, command: Any) -> None:
        self._exciter.publish(command)
        self._commands.append(command)
        self._answered_ns = max(self._answered_ns, nanoseconds(command.header.stamp))

    def _on_site(self, site: Any) -> None:
        self._site = site

    def _on_truth(self, truth: Any) -> None:
        self._truth[truth.sequence // N] = (truth.rmv, truth.mode)
        self._truth_until = truth.sequence + len(truth.vertical)

    def _arrived(self) -> bool:
        """Whether all is driven; driven by hand the roller stands at the lane's end."""
        site = self._site
        if site is None:
            return False
        return bool(
            site.finished or (site.travel_master == SiteState.MASTER_CMD_VEL and not site.speed)
        )

    def _told_until(self, sample: int) -> bool:
        site_until = 0 if self._site is None else self._site.last_sample + 1
        return bool(site_until >= sample and self._truth_until >= sample)

    def _advance(self, revolutions: int) -> int:
        """Step, and return the index of the sample that comes next."""
        future = self._client.call_async(Advance.Request(revolutions=revolutions))
        self._until(future.done, "the roller's answer to a step")
        response = future.result()
        if response.result.result != Result.RESULT_OK:
            raise RollerSimError(f"the roller does not step: {response.result.error_message}")
        return int(response.next_sample)

    def _until_answered(self) -> None:
        """Wait for the answer to the last ``meter``: all that the step published is here, or in the queue."""

        def answered() -> bool:
            return self._answered_ns >= self._asked_ns

        self._executor.spin_once(timeout_sec=0.0)
        if self._commands:
            self._until(answered, "the controller's answer")
        else:
            self._within(answered, self._join_s)
            self._join_s = min(2.0 * self._join_s, self._patience_s)

    def _until(self, done: Callable[[], Any], what: str) -> None:
        """Take messages until something is so.

        Raises
        ------
        RollerSimError
            If `what` is waited for in vain.
        """
        if not self._within(done, self._patience_s):
            raise RollerSimError(f"{what}: did not come within {self._patience_s:g} s")

    def _within(self, done: Callable[[], Any], duration_s: float) -> bool:
        """Take messages until something is so, for some time at most; return whether it is."""
        deadline = time.monotonic() + duration_s
        while not done():
            if time.monotonic() > deadline:
                return False
            self._executor.spin_once(timeout_sec=0.1)
        return True


@contextmanager
def process(module: str, *arguments: str, **options: Any) -> Iterator[subprocess.Popen[bytes]]:
    """Run a module as a process of its own; it is asked to end when the block ends."""
    child = subprocess.Popen([sys.executable, "-m", module, *arguments], cwd=ROOT, **options)
    try:
        yield child
    finally:
        child.terminate()
        child.wait(PATIENCE_S)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run a scenario with a controller in lock step."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("controller", choices=CONTROLLERS, help="which")
    parser.add_argument("--scenario", default="soft_to_stiff", help="name or file (%(default)s)")
    parser.add_argument("--revolutions-per-step", type=int, default=1, metavar="N", help="(1)")
    parser.add_argument("--record", metavar="FILE", help="trace of the run")
    given = parser.parse_args(arguments)
    record = ("--record", str(Path(given.record).absolute())) if given.record else ()
    scenario = Path(given.scenario)
    name = str(scenario.absolute()) if scenario.exists() else given.scenario
    roller = ("sim", "--scenario", name, "--lock-step", *record)
    whole = ("--ros-args", "-p", f"pacing.samples_per_message:={N}")
    with (
        process("roller_sim_ros.commands", *roller, *whole, stdout=subprocess.DEVNULL),
        process(f"examples.controllers.{given.controller}", "--ros-args", *REMAPPED),
        LockStep() as lock_step,
    ):
        begun = time.monotonic()
        run = lock_step.drive(revolutions_per_step=given.revolutions_per_step)
        took_s = time.monotonic() - begun
    amplitudes = [command.amplitude for command in run.commands]
    print(
        f"{len(run.true_rmv)} revolutions in {took_s:.1f} s; "
        f"double jump {100.0 * jumping(run.true_mode, run.true_rmv).mean():.1f} %; "
        f"mean amplitude {1e3 * float(np.mean(amplitudes)):.2f} mm; {run.unheard} commands unheard"
    )


if __name__ == "__main__":
    main()
