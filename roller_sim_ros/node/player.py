# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Republishes a trace: the recorded bytes, at the recorded spacing, with the recorded quality of service."""

from __future__ import annotations

import signal
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.signals import SignalHandlerOptions

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node.interfaces import message_type
from roller_sim_ros.node.qos import profile
from roller_sim_ros.traces.contents import TopicInfo
from roller_sim_ros.traces.playback import check_definition, timeline
from roller_sim_ros.traces.reader import TraceMessage, TraceReader
from roller_sim_ros.wire.qos import Qos
from roller_sim_ros.wire.types import TypeUnknownError

NAME = "roller_sim_player"

DEFAULT_QOS = Qos(reliability="reliable", durability="volatile", depth=1000)
"""For a topic of which the trace states none."""

AHEAD = 2000
"""Messages read ahead, in the time that is left until the next is due."""

IDLE_S = 0.5e-3
"""Time left that is enough to read one more message."""

LONGEST_SLEEP_S = 0.1
ACKNOWLEDGED_WITHIN_S = 1.0


@dataclass
class Played:
    """What was played.

    Attributes
    ----------
    messages : int
        Messages published.
    seconds : float
        How long it took.
    latest_s : float
        How late the latest message was.
    interrupted : bool
        Whether a signal ended it.
    """

    messages: int = 0
    seconds: float = 0.0
    latest_s: float = 0.0
    interrupted: bool = False


def play(
    reader: TraceReader,
    topics: Sequence[TopicInfo],
    ros_arguments: Sequence[str] = (),
    *,
    rate: float = 1.0,
    loop: bool = False,
    namespace: str = "",
    subscribers: int = 0,
    delay_s: float = 0.0,
    on_message: Callable[[Played], None] | None = None,
) -> Played:
    """Publish the messages of a trace until its end, SIGINT or SIGTERM.

    Parameters
    ----------
    reader : TraceReader
        The trace.
    topics : sequence of TopicInfo
        What is played.
    ros_arguments : sequence of str
        ``--ros-args`` and what follows.
    rate : float
        Speed over the original one.
    loop : bool
        Begin anew at the end.
    namespace : str
        Put in front of all names.
    subscribers : int
        Begin only when there are so many subscriptions to the topics together.
    delay_s : float
        Time from then to the first message, for subscribers to find the topics.
    on_message : callable, optional
        Told what was played so far, after each message.

    Raises
    ------
    RollerSimError
        If a topic's type is not installed or another than the recorded one, or ROS 2 refuses a name.
    """
    played = Played()
    with _node(ros_arguments) as node:
        publishers = {topic.name: _publisher(node, topic, namespace) for topic in topics}
        begin = time.monotonic()
        try:
            while sum(item.get_subscription_count() for item in publishers.values()) < subscribers:
                time.sleep(LONGEST_SLEEP_S)
            begin = time.monotonic() + delay_s
            for late_s, message in _paced(timeline(reader, topics, loop=loop), rate, begin):
                publishers[message.topic].publish(message.data)
                played.messages += 1
                played.latest_s = max(played.latest_s, late_s)
                if on_message is not None:
                    on_message(played)
            played.seconds = time.monotonic() - begin
            for publisher in publishers.values():
                publisher.wait_for_all_acked(Duration(nanoseconds=int(ACKNOWLEDGED_WITHIN_S * 1e9)))
        except KeyboardInterrupt:
            played.interrupted = True
            played.seconds = max(0.0, time.monotonic() - begin)
    return played


def _paced(
    source: Iterator[tuple[float, TraceMessage]], rate: float, begin: float
) -> Iterator[tuple[float, TraceMessage]]:
    """Yield (lateness, message) when the message is due: absolute deadlines on the steady clock."""
    ahead: deque[tuple[float, TraceMessage]] = deque()
    ended = False
    while True:
        wait_s = begin + ahead[0][0] / rate - time.monotonic() if ahead else LONGEST_SLEEP_S
        if not ended and len(ahead) < AHEAD and wait_s > IDLE_S:
            following = next(source, None)
            if following is None:
                ended = True
            else:
                ahead.append(following)
        elif not ahead:
            return
        elif wait_s > 0.0:
            time.sleep(min(wait_s, LONGEST_SLEEP_S))
        else:
            yield -wait_s, ahead.popleft()[1]


def _publisher(node: Node, topic: TopicInfo, namespace: str) -> Publisher[Any]:
    name = f"/{namespace.strip('/')}{topic.name}" if namespace.strip("/") else topic.name
    try:
        kind = message_type(topic.type_name)
        check_definition(topic)
    except TypeUnknownError as error:
        raise RollerSimError(
            f"topic {topic.name}: {error}, or leave the topic out with --topics"
        ) from error
    qos = Qos.from_offered_profiles(topic.offered_qos_profiles) or DEFAULT_QOS
    try:
        return node.create_publisher(kind, name, profile(qos))
    except Exception as error:  # rclpy's own, for a name that ROS 2 does not allow
        raise RollerSimError(f"topic {name}: {str(error).strip().splitlines()[0]}") from error


@contextmanager
def _node(ros_arguments: Sequence[str]) -> Iterator[Node]:
    """Yield a node; SIGINT and SIGTERM interrupt, also where a shell had SIGINT ignored."""

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    signals = (signal.SIGINT, signal.SIGTERM)
    before = {number: signal.signal(number, interrupt) for number in signals}
    try:
        try:
            # rclpy's own handlers would take the context away while messages are on their way.
            rclpy.init(args=list(ros_arguments), signal_handler_options=SignalHandlerOptions.NO)
        except Exception as error:
            reason = str(error).strip().splitlines()[0]
            raise RollerSimError(f"ROS 2 refuses its arguments: {reason}") from error
        node = rclpy.create_node(NAME, start_parameter_services=False, enable_rosout=False)
        try:
            yield node
        finally:
            node.destroy_node()
    finally:
        if rclpy.ok():
            rclpy.shutdown()
        for number, handler in before.items():
            signal.signal(number, handler)
