# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Hostile clients of a real node over DDS: messages, damaged messages, parameters, requests of every service."""

from __future__ import annotations

import math
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import rclpy
from geometry_msgs.msg import Twist
from hypothesis import strategies as st
from rcl_interfaces.msg import Parameter, ParameterValue
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

from fuzz import items
from fuzz.targets import LONGEST_REFUSAL, Target
from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.faults.catalogue import FAULTS
from roller_sim_ros.msg import (
    DrumSoilState,
    ExciterCommand,
    ExciterState,
    Result,
    SimulationState,
)
from roller_sim_ros.parameters import PARAMETERS
from roller_sim_ros.processes import Process
from roller_sim_ros.srv import (
    Advance,
    ClearFaults,
    GetSimulationState,
    InjectFault,
    ResetSimulation,
    RestoreState,
    SaveState,
    SetSimulationState,
    StepSimulation,
)

PATIENCE_S = 60.0
"""How long the node may take for anything."""
STEP = 128


@dataclass(frozen=True)
class Publication:
    """A message, or bytes that are to be one, on a topic that the node hears."""

    topic: str
    fields: tuple[Any, ...] | None
    data: bytes = b""


@dataclass(frozen=True)
class Request:
    """A request of a service."""

    service: str
    fields: dict[str, Any]


uint64 = st.integers(0, 2**64 - 1) | st.sampled_from([0, 1, 2**63, 2**64 - 1])
sendable = items.texts.filter(lambda text: not any(0xD800 <= ord(it) <= 0xDFFF for it in text))
numbers = st.sampled_from(["", "nan", "inf", "1e999", "1_0", "0x1", "½", "1,5", "true", "None"])
written = numbers | items.floats.map(repr) | sendable

publications = st.one_of(
    st.builds(
        Publication,
        st.just("exciter/command"),
        st.tuples(st.booleans(), items.floats, items.floats),
    ),
    st.builds(Publication, st.just("cmd_vel"), st.tuples(items.floats | st.floats(-3.0, 3.0))),
    st.builds(
        Publication,
        st.sampled_from(["exciter/command", "cmd_vel"]),
        st.none(),
        items.command_bytes.filter(lambda data: len(data) >= 4),
    ),
)


@st.composite
def parameters(draw: st.DrawFn) -> Parameter:
    """Draw a parameter as a client may send it: any name, any type, values that do not go with the type."""
    name = draw(items.names | sendable)
    value = ParameterValue(type=draw(st.integers(0, 9) | st.just(200)))
    value.bool_value = draw(st.booleans())
    value.integer_value = draw(st.integers(-(2**63), 2**63 - 1) | st.integers(-3, 300))
    value.double_value = draw(items.floats)
    value.string_value = draw(sendable | st.sampled_from(["circular", "sim", "/dev/null/x"]))
    value.double_array_value = draw(st.lists(items.floats, max_size=2))
    if draw(st.booleans()) and name in PARAMETERS:
        fitting = draw(items.fitting(name))
        kinds = {bool: (1, "bool"), int: (2, "integer"), float: (3, "double"), str: (4, "string")}
        value.type, kind = kinds[type(fitting)]
        setattr(value, f"{kind}_value", fitting)
    return Parameter(name=name, value=value)


def request(service: str, **fields: st.SearchStrategy[Any]) -> st.SearchStrategy[Request]:
    """Return requests of a service with drawn fields."""
    return st.builds(Request, st.just(service), st.fixed_dictionaries(fields))


sets = st.lists(parameters(), max_size=3)
# A step that would be taken is short, and the process is not asked to end.
seconds = st.sampled_from([0.0, 1e-9, 0.01]) | items.floats.filter(
    lambda it: not 0.02 < it <= 3600.0
)
few = st.sampled_from([0, 1, 2, 300_000, 2**64 - 1])
states = st.builds(
    SimulationState,
    state=st.integers(0, 255).filter(lambda it: it != SimulationState.STATE_QUITTING),
)
# None that can be written.
odd_paths = st.sampled_from(
    ["/", "/dev/null/state", "/no/such/folder/state", "\0", "x" * 5000, "/proc/state"]
)
requests = st.one_of(
    request("roller_sim/set_parameters", parameters=sets),
    request("roller_sim/set_parameters_atomically", parameters=sets),
    request("step_simulation", steps=st.sampled_from([0, 1, 2, 200, 50_000_000, 2**64 - 1])),
    request("advance", revolutions=few, seconds=seconds),
    request("reset_simulation", scope=st.integers(0, 255)),
    request("set_simulation_state", state=states | st.just(SimulationState(state=2))),
    request("save_state", path=odd_paths),
    request("restore_state", path=odd_paths | st.just(""), state=st.binary(max_size=80)),
    request(
        "inject_fault",
        fault_id=st.sampled_from(sorted(FAULTS)) | sendable,
        names=st.lists(
            st.sampled_from(["axis", "probability", "bias_m_s2"]) | sendable, max_size=3
        ),
        values=st.lists(written, max_size=3),
        duration_s=items.floats,
    ),
    request("clear_faults", handle=uint64 | st.integers(0, 9)),
    request("release"),
)
SERVICES: dict[str, Any] = {
    "roller_sim/set_parameters": SetParameters,
    "roller_sim/set_parameters_atomically": SetParametersAtomically,
    "step_simulation": StepSimulation,
    "advance": Advance,
    "reset_simulation": ResetSimulation,
    "set_simulation_state": SetSimulationState,
    "get_simulation_state": GetSimulationState,
    "save_state": SaveState,
    "restore_state": RestoreState,
    "inject_fault": InjectFault,
    "clear_faults": ClearFaults,
    "release": Trigger,
}


class HostileClient:
    """Talks to a node in lock step."""

    def __init__(self, domain: int, ended: Callable[[], str]) -> None:
        os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        self._ended = ended
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self._node = Node("hostile", context=self._context, enable_rosout=False)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._publishers = {
            "exciter/command": self._node.create_publisher(ExciterCommand, "exciter/command", 10),
            "cmd_vel": self._node.create_publisher(Twist, "cmd_vel", 10),
        }
        self._clients: dict[str, Any] = {
            name: self._node.create_client(kind, name) for name, kind in SERVICES.items()
        }
        self._truth: list[Any] = []
        self._states: list[Any] = []
        self._node.create_subscription(DrumSoilState, "truth", self._truth.append, 1000)
        self._node.create_subscription(ExciterState, "exciter/state", self._states.append, 1000)

    def close(self) -> None:
        """Leave the network."""
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()

    def wait_until_there(self) -> None:
        """Wait until the node hears everything."""
        self._wait(
            lambda: (
                all(it.service_is_ready() for it in self._clients.values())
                and all(it.get_subscription_count() for it in self._publishers.values())
                and self._node.count_publishers("truth")
            )
        )

    def feed(self, some: Sequence[Publication | Request]) -> list[bool]:
        """Send all, then see that the roller still goes on in numbers; return what was accepted.

        Of messages nobody says so; they count as accepted when they could be sent.
        """
        accepted = [
            self._publish(it) if isinstance(it, Publication) else self._ask(it) for it in some
        ]
        self._go_on()
        return accepted

    def _publish(self, item: Publication) -> bool:
        publisher = self._publishers[item.topic]
        if item.fields is None:
            try:
                publisher.publish(item.data)
            except RuntimeError:
                # More than the longest message of the type: the middleware does not send it.
                return False
        elif item.topic == "cmd_vel":
            message = Twist()
            (message.linear.x,) = item.fields
            publisher.publish(message)
        else:
            publisher.publish(
                ExciterCommand(
                    vibrate=item.fields[0], frequency=item.fields[1], amplitude=item.fields[2]
                )
            )
        return True

    def _ask(self, item: Request) -> bool:
        answer = self.call(item.service, **item.fields)
        if hasattr(answer, "results"):
            said = [(it.successful, it.reason) for it in answer.results]
        elif item.service.startswith("roller_sim/"):
            said = [(answer.result.successful, answer.result.reason)]
        elif hasattr(answer, "success"):
            said = [(answer.success, answer.message)]
        else:
            ok = answer.result.result == Result.RESULT_OK
            said = [(ok, answer.result.error_message)]
        for ok, reason in said:
            if not ok:
                assert reason.strip(), f"{item}: refused without a reason"
                assert "\n" not in reason, f"more than one line: {reason[:500]!r}"
                assert len(reason) <= LONGEST_REFUSAL, f"{len(reason)} characters: {reason[:300]}"
        return all(ok for ok, _ in said)

    def _go_on(self) -> None:
        """Let the roller be paused, whatever state it was brought to, and step a revolution."""
        self.call("set_simulation_state", state=SimulationState(state=SimulationState.STATE_PAUSED))
        before = len(self._truth)
        answer = self.call("advance", revolutions=1)
        assert answer.result.result == Result.RESULT_OK, answer.result.error_message
        self._wait(
            lambda: (
                len(self._truth) > before
                and self._truth[-1].sequence + len(self._truth[-1].soil_force) == answer.next_sample
            )
        )
        for block in self._truth:
            assert np.isfinite(block.vertical).all(), "the motion is no number"
            assert math.isfinite(block.shear_modulus)
        for state in self._states:
            assert (state.refusal_code != ExciterState.NONE) == bool(state.refusal_reason)
            assert "\n" not in state.refusal_reason
        self._truth.clear()
        self._states.clear()

    def call(self, service: str, **fields: Any) -> Any:
        """Return the answer of a service."""
        future = self._clients[service].call_async(SERVICES[service].Request(**fields))
        self._wait(future.done)
        return future.result()

    def _wait(self, done: Callable[[], Any]) -> None:
        end = time.monotonic() + PATIENCE_S
        while not done():
            ended = self._ended()
            assert not ended, ended
            assert time.monotonic() < end, f"no answer within {PATIENCE_S:g} s"
            self._executor.spin_once(timeout_sec=0.1)


@contextmanager
def hostile_client() -> Iterator[HostileClient]:
    """Yield a client of a node that was started for it; the node has to end in order after all."""
    with tempfile.TemporaryDirectory(prefix="roller_sim_fuzz_") as folder, own_domain() as domain:
        process: Process | None = None

        def ended() -> str:
            if process is None or process.code is None:
                return ""
            return f"the node ended with {process.code}; {process.said()}"

        client = HostileClient(domain, ended)
        try:
            process = Process(
                "node",
                [sys.executable, "-m", "roller_sim_ros.commands", "sim", "--lock-step"],
                Path(folder) / "node.log",
                {"ROS_DOMAIN_ID": str(domain), "ROS_LOG_DIR": folder},
                # It may be asked to record, to files of odd names.
                Path(folder),
            )
            client.wait_until_there()
            yield client
            process.end()
            assert process.code == 0, ended()
        finally:
            client.close()
            if process is not None:
                process.end()


def target(client: HostileClient) -> Target:
    """Return the target that goes over DDS."""
    return Target(
        "messages, damaged messages, parameters and requests over DDS, to a node in lock step",
        # Between two requests no more messages than the queues hold.
        st.lists(publications | requests, min_size=5, max_size=10),
        client.feed,
        0.1,
    )
