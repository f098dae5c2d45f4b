# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The node's recording: its own topics, the commands it receives, parameter events, and others' topics."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import rclpy.subscription
from rclpy.node import Node
from rclpy.subscription import Subscription

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node.interfaces import message_type
from roller_sim_ros.node.outlet import Outlet
from roller_sim_ros.node.qos import profile, row
from roller_sim_ros.node.report import RecordingReport
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.parameters import Recording as RecordingParameters
from roller_sim_ros.traces.recorder import Recorder
from roller_sim_ros.traces.registration import register
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.qos import Qos

DEPTH = 1000
"""Messages of others' topics that may wait for the executor."""

PATIENCE_S = 30.0
"""How long simulated time waits for a disk that is slow."""

# Humble's rclpy does not tell a callback when its message was sent.
_HAS_INFO = hasattr(rclpy.subscription, "MessageInfo")

Receiver = Callable[..., None]


def receiver(
    handle: Callable[[bytes, int, int], None], now_ns: Callable[[], int] | None = None
) -> Receiver:
    """Return a callback for a raw subscription that calls `handle` with bytes, receive and publish time.

    Parameters
    ----------
    handle : callable
        Takes them.
    now_ns : callable, optional
        The time that both are; those of the middleware when not given.
    """
    if now_ns is not None:
        return lambda data, *_: handle(data, now_ns(), now_ns())

    def with_info(data: bytes, info: dict[str, Any]) -> None:
        now_ns = time.time_ns()
        handle(data, info["received_timestamp"] or now_ns, info["source_timestamp"] or now_ns)

    def without_info(data: bytes) -> None:
        now_ns = time.time_ns()
        handle(data, now_ns, now_ns)

    return with_info if _HAS_INFO else without_info


class Recording:
    """A trace of the node.

    Parameters
    ----------
    node : rclpy.node.Node
        The node.
    outlet : Outlet
        Whose topics are registered; it hands its bytes over once it is attached.
    commands : mapping
        {resolved name: topic} of the commands that are handed over by `put_command`.
    configuration : Configuration
        How it is recorded; in simulated time it waits for the disk rather than drop anything.
    metadata : mapping
        What the trace says of the run.
    path : str
        File to write.
    now_ns : callable, optional
        When what others send is received; the middleware's times when not given.

    Attributes
    ----------
    parameters : RecordingParameters
        What was asked for.
    path : str
        As given.
    problems : dict
        Topics of others that cannot be recorded, and why.
    awaited : list of str
        Topics of others that nobody publishes yet.
    used : bool
        Whether a run has begun since the recording did; for the owner to say.

    Raises
    ------
    TraceError
        If the file cannot be made.
    """

    def __init__(
        self,
        node: Node,
        outlet: Outlet,
        commands: Mapping[str, topics.Topic],
        configuration: Configuration,
        metadata: Mapping[str, Mapping[str, str]],
        path: str,
        now_ns: Callable[[], int] | None = None,
    ) -> None:
        self.parameters: RecordingParameters = configuration.recording
        self.path = path
        self.problems: dict[str, str] = {}
        self.used = False
        self._node = node
        self._subscriptions: list[Subscription[Any]] = []
        self._now_ns = now_ns
        self.trace = Recorder(
            Path(path),
            metadata,
            flush_period_s=self.parameters.flush_period_s,
            patience_s=PATIENCE_S if configuration.pacing.simulated_time else 0.0,
        )
        names = [name.strip() for name in self.parameters.topics.split(",") if name.strip()]
        self._asked = dict.fromkeys(node.resolve_topic_name(name) for name in names)
        self.register_topics(outlet)
        for name, topic in commands.items():
            register(self.trace, name, topic.type_name, topic.qos(configuration.pacing))
        events = topics.PARAMETER_EVENTS
        self._record(events.name, events.type_name, events.qos(configuration.pacing))
        own = {publisher.topic_name for publisher in outlet.publishers.values()}
        own |= {*commands, events.name}
        self.awaited = [name for name in self._asked if name not in own]
        self.look_for_topics()

    def register_topics(self, outlet: Outlet) -> None:
        """Announce the topics of an outlet that is to be attached."""
        for topic in topics.TOPICS:
            publisher = outlet.publishers.get(topic.name)
            if publisher is not None:
                qos = row(publisher.qos_profile)
                register(self.trace, publisher.topic_name, topic.type_name, qos)

    def attach(self, outlet: Outlet) -> None:
        """Let an outlet, whose topics are registered, hand its bytes over from now on; takes no time."""
        outlet.imu_recorded = outlet.publishers[topics.IMU.name].topic_name in self._asked
        outlet.trace = self.trace

    def put_command(self, name: str, data: bytes, received_ns: int, published_ns: int) -> None:
        """Record a command as it came, under its resolved name."""
        self.trace.put(name, data, received_ns, published_ns)

    def look_for_topics(self) -> None:
        """Subscribe to those of the others' topics that someone publishes by now."""
        for name in list(self.awaited):
            publishers = self._node.get_publishers_info_by_topic(name)
            if not publishers:
                continue
            self.awaited.remove(name)
            qos = _for_all([row(item.qos_profile) for item in publishers])
            try:
                self._record(name, publishers[0].topic_type, qos)
            except RollerSimError as error:
                self.problems[name] = str(error)
                self._node.get_logger().error(f"{name} is not recorded: {error}")

    def report(self) -> RecordingReport:
        """Return how the recording is doing."""
        return RecordingReport(
            path=self.path,
            status=self.trace.status(),
            problems=dict(self.problems),
            awaited=tuple(self.awaited),
        )

    def close(self, timeout_s: float) -> None:
        """Finish the file, within that time or later by itself."""
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()
        self.trace.close(timeout_s)

    def _record(self, name: str, type_name: str, qos: Qos) -> None:
        message_class = message_type(type_name)
        register(self.trace, name, type_name, qos)

        def put(data: bytes, received_ns: int, published_ns: int) -> None:
            self.trace.put(name, data, received_ns, published_ns)

        self._subscriptions.append(
            self._node.create_subscription(
                message_class, name, receiver(put, self._now_ns), profile(qos), raw=True
            )
        )


def _for_all(offered: list[Qos]) -> Qos:
    """Return the strongest quality of service that all of the offered ones match; depths are not known."""
    reliable = all(item.reliability == "reliable" for item in offered)
    lasting = all(item.durability == "transient_local" for item in offered)
    return Qos(
        reliability="reliable" if reliable else "best_effort",
        durability="transient_local" if lasting else "volatile",
        depth=DEPTH,
    )
