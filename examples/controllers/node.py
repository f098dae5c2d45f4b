# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ROS 2 node around a law: its parameters, the topics that it reads, and an answer to every ``meter``."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import fields
from typing import Any

import rclpy
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

from examples.controllers.measurement import Collector, Law, Measurement
from roller_sim_ros.msg import CompactionMeter, DrumAcceleration, ExciterCommand, ExciterState

LOOK_S, SPIN_S = 0.02, 0.5
"""How often a roller is looked for, and how long a message is waited for at a time."""


class Controller(Node):
    """A node that lets a law answer, once a revolution, also when nothing changes: who steps the roller waits for it.

    Parameters
    ----------
    name : str
        Of the node.
    law : callable
        Makes the law; a dataclass, whose fields are the node's parameters.
    """

    def __init__(self, name: str, law: Callable[..., Law]) -> None:
        super().__init__(name)
        declared = [item for item in fields(law) if item.init]  # type: ignore[arg-type]
        self._law = law(
            **{
                item.name: self.declare_parameter(item.name, item.default).value
                for item in declared
            }
        )
        collector = Collector()
        self._subscriptions_made = [
            self.create_subscription(message, topic, self._answering(take), depth)
            for message, topic, take, depth in (
                (ExciterState, "exciter/state", collector.exciter_state, 10),
                (DrumAcceleration, "drum/acceleration", collector.acceleration, 1600),
                (CompactionMeter, "meter", collector.meter, 40),
            )
        ]
        self._speeds = self.create_publisher(Twist, "cmd_vel", 10)
        self._commands: Any = None
        self._looking = self.create_timer(LOOK_S, self._look)

    def _look(self) -> None:
        """Offer commands once the roller is found: who sees the offer may step it, and will be answered."""
        if all(it.get_publisher_count() for it in self._subscriptions_made):
            self._commands = self.create_publisher(ExciterCommand, "exciter/command", 10)
            self.destroy_timer(self._looking)

    def _answering(self, take: Callable[[Any], list[Measurement]]) -> Callable[[Any], None]:
        def on_message(message: Any) -> None:
            for measurement in take(message):
                self._answer(measurement)

        return on_message

    def _answer(self, measurement: Measurement) -> None:
        if self._commands is None:
            return
        command = self._law.update(measurement)
        # The exciter's command is the answer, so it comes last.
        if command.speed_m_s is not None:
            speed = Twist()
            speed.linear.x = command.speed_m_s
            self._speeds.publish(speed)
        answer = ExciterCommand(
            vibrate=True, frequency=command.frequency_hz, amplitude=command.amplitude_m
        )
        # Of the measurement: who waits for the answer knows it by that.
        second, nanosecond = divmod(measurement.stamp_ns, 10**9)
        answer.header.stamp = Time(sec=second, nanosec=nanosecond)
        self._commands.publish(answer)


def spin(name: str, law: Callable[..., Law]) -> None:
    """Run a controller until Ctrl-C."""
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        executor = SingleThreadedExecutor()
        executor.add_node(Controller(name, law))
        # Not rclpy.spin: a signal that comes right before it waits is noticed only when the waiting ends.
        while rclpy.ok():
            executor.spin_once(timeout_sec=SPIN_S)
    rclpy.try_shutdown()
