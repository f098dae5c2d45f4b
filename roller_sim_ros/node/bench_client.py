# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a bench does on the network: it finds the meter's topic, and steps the roller as fast as the meter answers."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.msg import Result
from roller_sim_ros.node.interfaces import message_type
from roller_sim_ros.srv import Advance
from roller_sim_ros.wire import topics

CLIENT, ROLLER = "bench", "roller_sim"
OF_EVERYONE = ("/rosout", "/parameter_events", "/clock")

LONGEST_ANSWER_S = 0.5
SHORTEST_ANSWER_S = 0.02
ANSWERS = 4.0
"""A meter is waited for this many times as long as it took at most, within the two bounds."""

LOOK_S = 0.05
LISTEN_S = 0.5


def someone_there(domain: int) -> bool:
    """Return whether a node is in a domain, as far as half a second tells."""
    with BenchClient(domain) as client:
        return bool(client.wait_for(client.others, lambda: True, LISTEN_S))


class BenchClient:
    """A node beside roller and meter.

    Parameters
    ----------
    domain : int
        ROS domain.
    """

    def __init__(self, domain: int) -> None:
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self._node = Node(CLIENT, context=self._context, enable_rosout=False)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._advance: Any = self._node.create_client(Advance, "advance")
        self._answers = 0
        self._slowest_s = LONGEST_ANSWER_S / ANSWERS

    def __enter__(self) -> BenchClient:
        return self

    def __exit__(self, *_: object) -> None:
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()

    def others(self) -> list[str]:
        """Return the names of all other nodes that are known yet."""
        return [name for name in self._node.get_node_names() if name != CLIENT]

    def meter_topics(self) -> dict[str, str]:
        """Return {topic: type} of what others than roller and bench publish, as far as it is known yet."""
        return {
            name: types[0]
            for name, types in self._node.get_topic_names_and_types()
            if name not in OF_EVERYONE
            and any(
                item.node_name not in (CLIENT, ROLLER)
                for item in self._node.get_publishers_info_by_topic(name)
            )
        }

    def resolved(self, name: str) -> str:
        """Return the absolute name of a topic."""
        return str(self._node.resolve_topic_name(name))

    def listens(self) -> bool:
        """Return whether someone listens to the roller's acceleration."""
        return self._node.count_subscribers(topics.ACCELERATION.name) > 0

    def recorded(self, topic: str) -> bool:
        """Return whether the roller has subscribed to a topic, or publishes it itself."""
        infos = [
            *self._node.get_subscriptions_info_by_topic(topic),
            *self._node.get_publishers_info_by_topic(topic),
        ]
        return any(item.node_name == ROLLER for item in infos)

    def steppable(self) -> bool:
        """Return whether the roller can be stepped."""
        return bool(self._advance.service_is_ready())

    def wait_for(
        self, done: Callable[[], Any], going_on: Callable[[], bool], patience_s: float
    ) -> Any:
        """Return what `done` returns as soon as that is true; None when it does not come to that.

        Parameters
        ----------
        done : callable
            Asked again and again.
        going_on : callable
            Whether there is still reason to wait.
        patience_s : float
            How long at most.
        """
        deadline = time.monotonic() + patience_s
        while going_on() and time.monotonic() < deadline:
            result = done()
            if result:
                return result
            self._executor.spin_once(timeout_sec=LOOK_S)
        return None

    def follow(self, topic: str, type_name: str) -> None:
        """Count the messages of a topic from now on."""
        # Best effort matches every publisher.
        quality = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._node.create_subscription(
            message_type(type_name), topic, self._on_answer, quality, raw=True
        )

    def run(
        self, going_on: Callable[[], bool], answers: Callable[[], bool], patience_s: float
    ) -> int:
        """Step the roller revolution by revolution until its process ends; return how many there were.

        Parameters
        ----------
        going_on : callable
            Whether the roller's process runs.
        answers : callable
            Whether there is a meter whose message is worth waiting for after a step, as long as it usually takes.
        patience_s : float
            How long a step may take.

        Raises
        ------
        RollerSimError
            If a step is refused or does not end.
        """
        revolutions = 0
        silent = False
        while going_on():
            before = self._answers
            future = self._advance.call_async(Advance.Request(revolutions=1))
            sent = time.monotonic()
            while not future.done() and going_on():
                self._executor.spin_once(timeout_sec=LOOK_S)
                if time.monotonic() - sent > patience_s:
                    raise RollerSimError(
                        f"the roller did not end revolution {revolutions} within {patience_s:g} s"
                    )
            if not future.done():
                break
            result = future.result().result
            if result.result != Result.RESULT_OK:
                if not self.wait_for(lambda: not going_on(), lambda: True, patience_s):
                    raise RollerSimError(f"the roller refuses to go on: {result.error_message}")
                break
            revolutions += 1
            if answers():
                silent = not self._wait_for_answer(before, going_on, silent=silent)
        return revolutions

    def _wait_for_answer(self, before: int, going_on: Callable[[], bool], *, silent: bool) -> bool:
        """Return whether a message came; a meter that has been silent is hardly waited for."""
        start = time.monotonic()
        longest = SHORTEST_ANSWER_S
        if not silent:
            longest = min(LONGEST_ANSWER_S, max(SHORTEST_ANSWER_S, ANSWERS * self._slowest_s))
        while self._answers == before and going_on():
            left = start + longest - time.monotonic()
            if left <= 0.0:
                return False
            self._executor.spin_once(timeout_sec=left)
        if before:
            self._slowest_s = max(0.9 * self._slowest_s, time.monotonic() - start)
        return True

    def _on_answer(self, _message: bytes) -> None:
        self._answers += 1
