# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a test does on the network: it steps the roller, commands it, and keeps what it publishes."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping
from typing import Any

import rclpy
from geometry_msgs.msg import Twist
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from rclpy.serialization import deserialize_message
from std_srvs.srv import Trigger

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.msg import ExciterCommand, Result
from roller_sim_ros.node.interfaces import message_type
from roller_sim_ros.node.qos import profile
from roller_sim_ros.node.step_length import check_advance, check_samples
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Pacing, Value
from roller_sim_ros.srv import (
    Advance,
    ClearFaults,
    GetSimulationState,
    InjectFault,
    StepSimulation,
)
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.qos import Qos

CLIENT, ROLLER = "roller_test", "roller_sim"
DEPTH = 100_000
"""Messages that may come between two calls."""
LOOK_S = 0.05
IDLE = 3
"""Looks without a message after which none is there: a look may find something else to do."""
LONGEST_NS = 10**9
"""No revolution is longer, at the lowest sampling floor there is."""
_SERVICES: dict[str, Any] = {
    "advance": Advance,
    "step_simulation": StepSimulation,
    "get_simulation_state": GetSimulationState,
    "inject_fault": InjectFault,
    "clear_faults": ClearFaults,
    "release": Trigger,
    f"{ROLLER}/set_parameters_atomically": SetParametersAtomically,
}


class SteppingClient:
    """A node beside a roller in lock step.

    Parameters
    ----------
    domain : int
        ROS domain.
    going_on : callable
        Raises when there is no reason to wait any more, as the roller's process has ended.
    patience_s : float
        How long anything may take.

    Attributes
    ----------
    node : rclpy.node.Node
        For whatever a test does beside; spun while one of the methods waits.
    """

    def __init__(self, domain: int, going_on: Callable[[], None], patience_s: float) -> None:
        # Before rclpy reads it: what is on this machine is for it alone.
        os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        self._going_on = going_on
        self._patience_s = patience_s
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self.node = Node(CLIENT, context=self._context, enable_rosout=False)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._types: dict[str, Any] = {}
        self._raw: dict[str, list[bytes]] = {}
        self._read: dict[str, list[Any]] = {}
        self._arrived = 0
        self._looked_at = 0
        self._next_sample = self._next_ns = 0
        self._longest_ns = LONGEST_NS
        self._clients: dict[str, Any] = {
            name: self.node.create_client(service, name) for name, service in _SERVICES.items()
        }
        self._command = self.node.create_publisher(ExciterCommand, "exciter/command", 10)
        self._travel = self.node.create_publisher(Twist, "cmd_vel", 10)
        for topic in topics.TOPICS:
            # The messages of each sample are for those who ask for them.
            if topic.direction is topics.Direction.PUBLISHED and topic is not topics.IMU:
                qos = Qos("reliable", topic.qos(Pacing()).durability, DEPTH)
                self.listen(topic.name, message_type(topic.type_name), profile(qos))

    def close(self) -> None:
        """Leave the network."""
        self._executor.shutdown()
        self.node.destroy_node()
        self._context.try_shutdown()

    def wait_until_there(self) -> None:
        """Wait until the roller can be commanded and stepped."""
        self.wait_for(
            lambda: (
                all(client.service_is_ready() for client in self._clients.values())
                and self._command.get_subscription_count()
                and self._travel.get_subscription_count()
                and all(
                    self.node.count_publishers(topic.name)
                    for topic in topics.TOPICS
                    if topic.name in self._types and topic is not topics.PARAMETER_EVENTS
                )
            ),
            "the roller's topics and services",
        )
        self.wait_for(
            lambda: (
                self._call("get_simulation_state").state.state
                == GetSimulationState.Response().state.STATE_PAUSED
            ),
            "the roller to be active",
        )

    def listen(self, topic: str, kind: Any, qos: QoSProfile | int = DEPTH) -> None:
        """Keep what comes on a topic from now on."""
        if topic in self._types:
            return
        self._types[topic] = kind
        self._raw[topic], self._read[topic] = [], []

        def keep(data: bytes) -> None:
            self._raw[topic].append(data)
            self._arrived += 1

        self.node.create_subscription(kind, topic, keep, qos, raw=True)

    def received(self, topic: str) -> list[Any]:
        """Return the messages of a topic, the oldest first.

        Raises
        ------
        RollerSimError
            If nobody listens to it.
        """
        if topic not in self._types:
            raise RollerSimError(
                f"topic {topic}: is not listened to; there are {', '.join(self._types)}, others by listen()"
            )
        read = self._read[topic]
        for data in self._raw[topic][len(read) :]:
            read.append(deserialize_message(data, self._types[topic]))
        return list(read)

    def step(self, *, revolutions: int, seconds: float, samples: int) -> int:
        """Step, and return the index of the next sample when all that was published on the way has come.

        It goes by a revolution at a time: shared memory takes 512 messages that a process has not fetched yet, and what
        comes on top of them is sent again seconds later, when the step may be long over.
        """
        if samples:
            check_samples(samples)
        else:
            check_advance(revolutions, seconds)
        if seconds:
            end_ns = self._next_ns + round(seconds * 1e9)
            while end_ns - self._next_ns > self._longest_ns:
                self._step_by(self._to_revolution)
            response = self._call("advance", seconds=(end_ns - self._next_ns) * 1e-9)
            self._checked(response)
            self._take_until(int(response.next_sample))
        last = self._next_sample + revolutions * SAMPLES_PER_REVOLUTION + samples
        while self._next_sample < last:
            self._step_by(min(last - self._next_sample, self._to_revolution))
        return self._next_sample

    @property
    def _to_revolution(self) -> int:
        return SAMPLES_PER_REVOLUTION - self._next_sample % SAMPLES_PER_REVOLUTION

    def _step_by(self, samples: int) -> None:
        self._checked(self._call("step_simulation", steps=samples))
        self._take_until(self._next_sample + samples)

    def _take_until(self, next_sample: int) -> None:
        """Take all that was published before a sample."""
        self.wait_for(lambda: self._truth_is_there(next_sample), "the samples of the step")
        self._drain()

    def command(self, *, vibrate: bool, frequency_hz: float, amplitude_m: float) -> None:
        """Publish an exciter command, and return when the roller has it."""
        self._command.publish(
            ExciterCommand(
                vibrate=vibrate, frequency=float(frequency_hz), amplitude=float(amplitude_m)
            )
        )
        self._handed_over()

    def drive(self, speed_m_s: float) -> None:
        """Publish a travel command, and return when the roller has it."""
        message = Twist()
        message.linear.x = float(speed_m_s)
        self._travel.publish(message)
        self._handed_over()

    def release(self) -> None:
        """Hand exciter and travel back to the scenario."""
        self._told(self._call("release"))

    def set_parameters(self, values: Mapping[str, Value]) -> None:
        """Set parameters, all or none."""
        items = [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
        result = self._call(f"{ROLLER}/set_parameters_atomically", parameters=items).result
        if not result.successful:
            raise RollerSimError(result.reason)

    def inject(self, fault_id: str, duration_s: float, values: Mapping[str, Value]) -> int:
        """Let a fault be active and return its handle."""
        response = self._call(
            "inject_fault",
            fault_id=fault_id,
            duration_s=float(duration_s),
            names=list(values),
            values=[_text(value) for value in values.values()],
        )
        self._told(response)
        return int(response.handle)

    def clear(self, handle: int) -> None:
        """End a fault, or all that were injected."""
        self._told(self._call("clear_faults", handle=handle))

    def wait_for(self, done: Callable[[], Any], what: str) -> Any:
        """Take messages until `done` returns something true, and return that.

        Raises
        ------
        RollerSimError
            If it does not come to that.
        """
        deadline = time.monotonic() + self._patience_s
        while True:
            result = done()
            if result:
                return result
            self._going_on()
            if time.monotonic() > deadline:
                raise RollerSimError(f"waited {self._patience_s:g} s for {what}")
            self._executor.spin_once(timeout_sec=LOOK_S)

    def _call(self, name: str, **fields: Any) -> Any:
        future = self._clients[name].call_async(_SERVICES[name].Request(**fields))
        self.wait_for(future.done, f"the answer of {name}")
        return future.result()

    def _handed_over(self) -> None:
        """Wait until the roller has taken what was published: it takes messages before requests that come later."""
        self._call("get_simulation_state")

    def _drain(self) -> None:
        """Take what has come: all that was sent before the answer to the step has."""
        idle = 0
        while idle < IDLE:
            arrived = self._arrived
            self._executor.spin_once(timeout_sec=0.0)
            idle = 0 if self._arrived > arrived else idle + 1

    def _truth_is_there(self, next_sample: int) -> bool:
        """Return whether the truth, which no fault keeps away, has come up to a sample."""
        raw = self._raw[topics.TRUTH.name]
        if len(raw) != self._looked_at:
            self._looked_at = len(raw)
            truth = deserialize_message(raw[-1], self._types[topics.TRUTH.name])
            size, stamp = len(truth.soil_force), truth.header.stamp
            self._next_sample = int(truth.sequence) + size
            self._next_ns = (
                stamp.sec * 10**9 + stamp.nanosec + round(size * truth.sample_period * 1e9)
            )
            # The next revolution may be longer than this one, but not so much.
            self._longest_ns = round(2.0 * SAMPLES_PER_REVOLUTION * truth.sample_period * 1e9)
        return self._next_sample >= next_sample

    @staticmethod
    def _checked(response: Any) -> None:
        if response.result.result != Result.RESULT_OK:
            raise RollerSimError(response.result.error_message)

    @staticmethod
    def _told(response: Any) -> None:
        if not response.success:
            raise RollerSimError(response.message)


def _text(value: Value) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
