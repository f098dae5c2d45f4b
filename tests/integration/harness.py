# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the tests between processes share: the node as a process, and a client of it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from itertools import count
from pathlib import Path
from typing import Any

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.qos import QoSProfile

from roller_sim_ros.msg import ExciterCommand, Result
from roller_sim_ros.srv import Advance
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.wire.types import decode

PATIENCE_S = 30.0
"""Generous: how long anything may take before the test fails."""

NODE = "roller_sim"
_NUMBERS = count()
TRANSITIONS = {
    "configure": Transition.TRANSITION_CONFIGURE,
    "activate": Transition.TRANSITION_ACTIVATE,
    "deactivate": Transition.TRANSITION_DEACTIVATE,
    "cleanup": Transition.TRANSITION_CLEANUP,
    "shutdown": Transition.TRANSITION_UNCONFIGURED_SHUTDOWN,
}


def roller_sim(command: str, *arguments: object) -> str:
    """Run another command of ``roller-sim`` and return its output."""
    done = subprocess.run(
        [sys.executable, "-m", "roller_sim_ros.commands", command, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def recorded(bag: Path, topic: str) -> list[Any]:
    """Return the messages of a topic of a bag."""
    reader = TraceReader(bag)
    return [decode(item.data, item.type_name) for item in reader.messages([topic])]


class Sim:
    """``roller-sim sim`` in a process of its own; its output goes to files in `folder`."""

    def __init__(self, folder: Path, domain: int, *arguments: str, **environment: str) -> None:
        self.output = folder / f"{time.monotonic_ns()}.out"
        self.errors = self.output.with_suffix(".err")
        self.started = time.monotonic()
        with self.output.open("wb") as output, self.errors.open("wb") as errors:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "roller_sim_ros.commands", "sim", *arguments],
                stdout=output,
                stderr=errors,
                cwd=folder,
                env={
                    **os.environ,
                    "ROS_DOMAIN_ID": str(domain),
                    "ROS_LOG_DIR": str(folder),
                    "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
                    **environment,
                },
                # Of its own, so that Ctrl-C in the terminal of the tests is not for it.
                start_new_session=True,
            )

    def __enter__(self) -> Sim:
        return self

    def __exit__(self, *_: object) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()

    def end(self, number: int = signal.SIGINT) -> int:
        """Send a signal and return the exit code."""
        self.process.send_signal(number)
        return self.wait()

    def wait(self) -> int:
        """Return the exit code of a process that ends by itself."""
        return self.process.wait(PATIENCE_S)

    def child(self) -> int:
        """Return the id of the process that writes its recording, 0 when there is none yet."""
        pid = self.process.pid
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii").split()
        return int(children[0]) if children else 0

    @property
    def said(self) -> str:
        """Its standard output so far."""
        return self.output.read_text(encoding="utf-8")

    @property
    def complaints(self) -> list[str]:
        """The lines of its standard error so far."""
        return self.errors.read_text(encoding="utf-8").splitlines()


class Client:
    """A node in this process that talks to the roller."""

    def __init__(self, domain: int, namespace: str = "") -> None:
        self.context = Context()
        rclpy.init(context=self.context, domain_id=domain)
        name = f"client_{next(_NUMBERS)}"
        self.node = Node(name, context=self.context, namespace=namespace)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self._commands = self.node.create_publisher(ExciterCommand, "exciter/command", 10)
        self._services: dict[str, Any] = {}
        self._subscriptions: list[Any] = []

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        self.context.try_shutdown()

    def listen(self, topic: str, message: type, qos: QoSProfile | int = 1000) -> list[Any]:
        """Return the list that the messages of a topic will go to."""
        received: list[Any] = []
        self._subscriptions.append(
            self.node.create_subscription(message, topic, received.append, qos)
        )
        return received

    def listen_no_more(self) -> None:
        """Take no more messages of any topic."""
        for subscription in self._subscriptions:
            self.node.destroy_subscription(subscription)
        self._subscriptions.clear()

    def spin_until(self, done: Callable[[], Any], patience_s: float = PATIENCE_S) -> Any:
        """Take messages until `done` returns something true, and return that.

        The last message of a topic of which none has come yet is none that it could look at: it is asked again.
        """
        deadline = time.monotonic() + patience_s
        while time.monotonic() < deadline:
            with suppress(IndexError):
                result = done()
                if result:
                    return result
            self.executor.spin_once(timeout_sec=0.1)
        raise AssertionError(f"not within {patience_s:g} s")

    def spin_for(self, duration_s: float) -> None:
        """Take messages for some time."""
        end = time.monotonic() + duration_s
        while time.monotonic() < end:
            self.executor.spin_once(timeout_sec=max(0.0, min(0.1, end - time.monotonic())))

    def command(self, *, vibrate: bool = True, frequency: float = 28.0, amplitude: float) -> None:
        """Command the exciter, once the roller is there to hear it."""
        self.spin_until(self._commands.get_subscription_count)
        self._commands.publish(
            ExciterCommand(vibrate=vibrate, frequency=frequency, amplitude=amplitude)
        )

    def set_parameters(self, values: Mapping[str, Any]) -> list[Any]:
        """Set parameters of the roller, one by one, and return the results."""
        request = SetParameters.Request(
            parameters=[
                Parameter(name, value=value).to_parameter_msg() for name, value in values.items()
            ]
        )
        return list(self.call(SetParameters, "set_parameters", request).results)

    def set_parameter(self, name: str, value: Any) -> Any:
        """Set one parameter of the roller and return the result."""
        return self.set_parameters({name: value})[0]

    def set_parameter_message(self, message: Any) -> Any:
        """Set one parameter, given as a message, and return the result."""
        request = SetParameters.Request(parameters=[message])
        return self.call(SetParameters, "set_parameters", request).results[0]

    def get_parameter(self, name: str) -> Any:
        """Return a parameter of the roller."""
        request = GetParameters.Request(names=[name])
        return parameter_value_to_python(
            self.call(GetParameters, "get_parameters", request).values[0]
        )

    def describe_parameter(self, name: str) -> Any:
        """Return the descriptor of a parameter of the roller."""
        request = DescribeParameters.Request(names=[name])
        return self.call(DescribeParameters, "describe_parameters", request).descriptors[0]

    def change_state(self, transition: str) -> bool:
        """Return whether a transition of the roller's life succeeded."""
        request = ChangeState.Request(transition=Transition(id=TRANSITIONS[transition]))
        return bool(self.call(ChangeState, "change_state", request).success)

    def state(self) -> str:
        """Return the label of the roller's state."""
        return str(self.call(GetState, "get_state", GetState.Request()).current_state.label)

    def call(self, service: type, name: str, request: Any) -> Any:
        """Call a service that the roller has as a node and return its response."""
        return self._call(service, f"{NODE}/{name}", request)

    def ask(self, service: type, name: str, **fields: Any) -> Any:
        """Call a service of the simulation, the request given by its fields, and return the response."""
        return self._call(service, name, service.Request(**fields))

    def advance(self, **fields: Any) -> Any:
        """Step by revolutions or seconds, which has to succeed, and return the response."""
        response = self.ask(Advance, "advance", **fields)
        assert response.result.result == Result.RESULT_OK, response.result.error_message
        return response

    def _call(self, service: type, name: str, request: Any) -> Any:
        client = self._services.get(name)
        if client is None:
            client = self.node.create_client(service, name)
            self._services[name] = client
        self.spin_until(client.service_is_ready)
        future = client.call_async(request)
        self.spin_until(future.done)
        return future.result()


def entry(diagnostics: list[DiagnosticArray], what: str) -> Any:
    """Return the newest diagnostic entry about something, None when there is none yet."""
    for message in reversed(diagnostics):
        for status in message.status:
            if status.name.endswith(f": {what}"):
                return status
    return None


def values(status: Any) -> dict[str, str]:
    """Return the values of a diagnostic entry by name."""
    return {item.key: item.value for item in status.values}
