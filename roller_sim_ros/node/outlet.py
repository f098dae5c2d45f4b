# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where messages leave: each is published, and the same bytes are recorded."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import Any

from rclpy.node import Node
from rclpy.publisher import Publisher

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node.interfaces import message_type
from roller_sim_ros.node.qos import overridable, overrides_of, profile
from roller_sim_ros.parameters import Pacing
from roller_sim_ros.traces.recorder import Recorder
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.messages import Message

try:
    from rclpy.event_handler import PublisherEventCallbacks
except ImportError:  # Humble
    from rclpy.qos_event import PublisherEventCallbacks


class Outlet:
    """The publishers of all topics of the table; safe to use from several threads.

    Parameters
    ----------
    node : rclpy.node.Node
        Whose publishers they are.
    pacing : Pacing
        Depths depend on it, and whether there is a ``/clock``.
    now_ns : callable
        When what is recorded was sent, ns.

    Raises
    ------
    RollerSimError
        If a quality of service is refused that parameters ask for.

    Attributes
    ----------
    trace : Recorder or None
        Where the bytes go, too; the topics are registered there by their resolved names.
    imu_recorded : bool
        Whether the per-sample messages are to go there although nobody listens to them.
    publishers : dict
        By the names of the table.
    unsent : int
        Messages that the middleware refused to send; they are recorded all the same.
    """

    def __init__(
        self, node: Node, pacing: Pacing, now_ns: Callable[[], int] = time.time_ns
    ) -> None:
        self.trace: Recorder | None = None
        self.imu_recorded = False
        self.publishers: dict[str, Publisher[Any]] = {}
        self.unsent = 0
        self._node = node
        self._now_ns = now_ns
        self._lasting = {it.name for it in topics.TOPICS if it.durability == "transient_local"}
        # Every handler of an event costs each step of a client its share; readers are warned by their own side, too.
        self._events = PublisherEventCallbacks(use_default_callbacks=not pacing.simulated_time)
        try:
            for topic in topics.TOPICS:
                if _wanted(topic, pacing):
                    self._open(topic, pacing)
        except RollerSimError:
            self.destroy()
            raise
        self._names = {name: item.topic_name for name, item in self.publishers.items()}

    def send(self, messages: Iterable[Message]) -> None:
        """Publish messages, in order, and hand them to the recording; what nobody would get is only recorded."""
        trace = self.trace
        for message in messages:
            publisher = self.publishers[message.topic]
            try:
                if message.topic in self._lasting or publisher.get_subscription_count():
                    publisher.publish(message.data)
            except RuntimeError:
                # The middleware gives up where a reader or the machine is too slow for it.
                self.unsent += 1
            if trace is not None:
                now_ns = self._now_ns()
                trace.put(self._names[message.topic], message.data, now_ns, now_ns)

    def announce(self, message: Message) -> None:
        """Publish again what was published before, if its topic is open; it is not recorded again."""
        publisher = self.publishers.get(message.topic)
        if publisher is not None:
            with suppress(RuntimeError):
                publisher.publish(message.data)

    def imu_wanted(self) -> bool:
        """Return whether anyone listens to the per-sample messages, or the recording is to have them."""
        recorded = self.trace is not None and self.imu_recorded
        return recorded or bool(self.publishers[topics.IMU.name].get_subscription_count())

    def _open(self, topic: topics.Topic, pacing: Pacing) -> None:
        with overrides_of(topic):
            self.publishers[topic.name] = self._node.create_publisher(
                message_type(topic.type_name),
                topic.name,
                profile(topic.qos(pacing)),
                event_callbacks=self._events,
                qos_overriding_options=overridable(),
            )

    def destroy(self) -> None:
        """Destroy the publishers."""
        for publisher in self.publishers.values():
            self._node.destroy_publisher(publisher)
        self.publishers.clear()


def _wanted(topic: topics.Topic, pacing: Pacing) -> bool:
    if topic is topics.CLOCK and not pacing.publish_clock:
        return False
    return topic.direction is topics.Direction.PUBLISHED and (
        pacing.simulated_time or not topic.of_simulated_time
    )
