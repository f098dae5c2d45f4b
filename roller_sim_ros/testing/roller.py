# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A roller in lock step for one test: a process in a ROS domain of its own, and a client of it."""

from __future__ import annotations

import math
import os
import signal
import sys
from collections.abc import Callable
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import Value
from roller_sim_ros.processes import Process

if TYPE_CHECKING:
    from roller_sim_ros.node.stepping_client import SteppingClient

PATIENCE_S = 60.0
"""How long anything may take before the test fails: the kernels may have to be compiled."""


class RollerEnded(RollerSimError):
    """The roller's process, or that of a program under test, ended while it was needed."""


class Roller:
    """``roller-sim sim --lock-step`` beside a test; nothing moves until the test steps it.

    Parameters
    ----------
    folder : Path
        Where trace and logs go; made if it is not there.
    *arguments : str
        Further arguments of ``roller-sim sim``, as in ``"--scenario", "soft_to_stiff"``.
    patience_s : float
        How long anything may take before it is an error.

    Attributes
    ----------
    domain : int
        ROS domain, which nobody else on this machine uses.
    trace : Path
        What the roller records.

    Raises
    ------
    RollerSimError
        On entering, if the roller cannot be started with these arguments; the message has its last words.

    Examples
    --------
    ::

        with Roller(Path("run")) as roller:
            roller.step(revolutions=20)
            print(roller.last("meter").cmv)
    """

    def __init__(self, folder: Path, *arguments: str, patience_s: float = PATIENCE_S) -> None:
        self.folder = folder
        self.trace = folder / "trace.mcap"
        self.domain = -1
        self._arguments = arguments
        self._patience_s = patience_s
        self._stack = ExitStack()
        self._processes: list[Process] = []
        self._client: SteppingClient | None = None

    def __enter__(self) -> Roller:
        from roller_sim_ros.node.stepping_client import SteppingClient

        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self.domain = self._stack.enter_context(own_domain())
            self._client = SteppingClient(self.domain, self._check, self._patience_s)
            self._stack.callback(self._client.close)
            command = [sys.executable, "-m", "roller_sim_ros.commands", "sim", "--lock-step"]
            self.start("roller", *command, "--record", str(self.trace), *self._arguments)
            self._client.wait_until_there()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self._client = None
        self._stack.close()

    @property
    def environment(self) -> dict[str, str]:
        """Variables by which another program finds the roller."""
        return {
            "ROS_DOMAIN_ID": str(self.domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": os.environ.get(
                "ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"
            ),
        }

    @property
    def node(self) -> Any:
        """An rclpy node of the test in the roller's domain; it is spun whenever the test steps or waits."""
        return self._there.node

    def start(self, name: str, *command: str) -> Process:
        """Start a program under test in the roller's domain; it ends with the roller.

        Parameters
        ----------
        name : str
            What it is, for messages and its log.
        *command : str
            Program and arguments.
        """
        process = Process(name, command, self.folder / f"{name}.log", self.environment)
        self._stack.callback(process.end)
        self._processes.append(process)
        return process

    def kill(self, process: Process) -> None:
        """End a program under test as a crash would: at once, with all that it started."""
        self._processes.remove(process)
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    def step(self, *, revolutions: int = 0, seconds: float = 0.0, samples: int = 0) -> int:
        """Go on by revolutions, seconds or samples; what was published on the way has come then.

        Parameters
        ----------
        revolutions, seconds, samples : number
            One of them.

        Returns
        -------
        int
            Index of the next sample.

        Raises
        ------
        RollerSimError
            If not exactly one of them is given, or the roller refuses.
        """
        given = [it for it in (revolutions, seconds, samples) if it]
        if len(given) != 1 or not 0.0 < given[0] < math.inf:
            raise RollerSimError(
                f"step(revolutions={revolutions}, seconds={seconds}, samples={samples}): "
                "give one of them, greater than 0"
            )
        return self._there.step(revolutions=revolutions, seconds=seconds, samples=samples)

    def command(self, *, frequency_hz: float, amplitude_m: float, vibrate: bool = True) -> None:
        """Publish an exciter command; it takes effect with the next revolution.

        One that the roller refuses is none here: ``last("exciter/state")`` says why after the next step.
        """
        self._there.command(vibrate=vibrate, frequency_hz=frequency_hz, amplitude_m=amplitude_m)

    def drive(self, speed_m_s: float) -> None:
        """Publish a travel command, forward positive; it takes effect with the next revolution."""
        self._there.drive(speed_m_s)

    def release(self) -> None:
        """Hand exciter and travel back to the scenario."""
        self._there.release()

    def set_parameters(self, **values: Value) -> None:
        """Set parameters, all or none; dots in their names are double underscores here.

        As in ``set_parameters(soil__shear_modulus_pa=80e6)``.

        Raises
        ------
        RollerSimError
            If one is refused; the message is the roller's reason.
        """
        self._there.set_parameters(
            {name.replace("__", "."): value for name, value in values.items()}
        )

    def inject(self, fault_id: str, *, duration_s: float = 0.0, **parameters: Value) -> int:
        """Let a fault be active from the next revolution on, and return its handle.

        Parameters
        ----------
        fault_id : str
            Of the catalogue.
        duration_s : float
            How long, in simulated time; 0: until it is cleared.
        **parameters
            What differs from the fault's defaults.

        Raises
        ------
        RollerSimError
            If it is refused; the message is the roller's reason.
        """
        return self._there.inject(fault_id, duration_s, parameters)

    def clear(self, handle: int = 0) -> None:
        """End a fault with the revolution that runs; 0: all that were injected."""
        self._there.clear(handle)

    def listen(self, topic: str, kind: Any) -> None:
        """Keep what comes on a further topic, as a meter's, from now on.

        Parameters
        ----------
        topic : str
            Its name.
        kind : type
            Its message class.
        """
        self._there.listen(topic, kind)

    def received(self, topic: str) -> list[Any]:
        """Return all messages that came on a topic of the roller, or one of `listen`; the oldest first."""
        return self._there.received(topic)

    def last(self, topic: str) -> Any:
        """Return the last message of a topic.

        Raises
        ------
        RollerSimError
            If none has come yet.
        """
        found = self.received(topic)
        if not found:
            raise RollerSimError(f"topic {topic}: nothing has come yet; step first, or wait_for it")
        return found[-1]

    def wait_for(self, done: Callable[[], Any], what: str = "what the test waits for") -> Any:
        """Take messages until `done` returns something true, and return that; the roller stands meanwhile.

        Raises
        ------
        RollerSimError
            If it does not come to that.
        """
        return self._there.wait_for(done, what)

    @property
    def _there(self) -> SteppingClient:
        if self._client is None:
            raise RollerSimError("the roller is not there: use it in its with block")
        return self._client

    def _check(self) -> None:
        for process in self._processes:
            if process.code is not None:
                raise RollerEnded(f"the {process.name} ended with {process.code}; {process.said()}")
