# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Counts the samples that come, and steps."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile

from roller_sim_ros.msg import DrumAcceleration, DrumSoilState, Result
from roller_sim_ros.srv import Advance
from roller_sim_ros.wire.types import decode

DEPTH = 20_000


class SoakError(Exception):
    """The soak cannot go on."""


@dataclass
class Stream:
    """What came of blocks of samples.

    Attributes
    ----------
    samples : int
        Samples that came.
    lost : int
        Samples missing between blocks.
    first_sample, next_sample : int
        Index of the first one, and of the one that comes next.
    first_ns, last_ns : int
        Stamps of the first and of the last block.
    last_size : int
        Samples of the last block.
    """

    samples: int = 0
    lost: int = 0
    first_sample: int = -1
    next_sample: int = 0
    first_ns: int = 0
    last_ns: int = 0
    last_size: int = 0

    def add(self, sequence: int, size: int, stamp: Any) -> None:
        """Take the next block."""
        stamp_ns = stamp.sec * 10**9 + stamp.nanosec
        if self.first_sample < 0:
            self.first_sample, self.first_ns, self.next_sample = sequence, stamp_ns, sequence
        self.lost += abs(sequence - self.next_sample)
        self.samples += size
        self.next_sample = sequence + size
        self.last_ns, self.last_size = stamp_ns, size


class Client:
    """A node beside the roller.

    Parameters
    ----------
    domain : int
        ROS domain.
    going_on : callable
        Whether the roller's process runs.
    """

    def __init__(self, domain: int, going_on: Callable[[], bool]) -> None:
        os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        self._going_on = going_on
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self._node = Node("soak", context=self._context, enable_rosout=False)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._advance: Any = self._node.create_client(Advance, "advance")
        self.acceleration, self.truth = Stream(), Stream()
        self.lateness_s: list[float] = []
        for topic, kind, stream, field in (
            ("drum/acceleration", DrumAcceleration, self.acceleration, "vertical"),
            ("truth", DrumSoilState, self.truth, "soil_force"),
        ):
            self._listen(topic, kind, stream, field)

    def _listen(self, topic: str, kind: Any, stream: Stream, field: str) -> None:
        type_name = f"roller_sim_ros/msg/{kind.__name__}"

        def take(data: bytes) -> None:
            message = decode(data, type_name)
            size = len(getattr(message, field))
            stream.add(message.sequence, size, message.header.stamp)
            if stream is self.truth:
                # Against the steady clock, from some zero.
                self.lateness_s.append(time.monotonic() - stream.last_ns * 1e-9)

        self._node.create_subscription(kind, topic, take, QoSProfile(depth=DEPTH), raw=True)

    def close(self) -> None:
        """Leave the network."""
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()

    def spin_for(self, seconds: float) -> None:
        """Take messages for some time."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self._check()
            self._executor.spin_once(timeout_sec=max(0.0, min(0.1, end - time.monotonic())))

    def spin_until(self, done: Callable[[], Any], what: str, patience_s: float = 120.0) -> None:
        """Take messages until something holds.

        Raises
        ------
        SoakError
            If it does not come to that.
        """
        end = time.monotonic() + patience_s
        while not done():
            self._check()
            if time.monotonic() > end:
                raise SoakError(f"waited {patience_s:g} s for {what}")
            self._executor.spin_once(timeout_sec=0.1)

    def wait_until_steppable(self) -> None:
        """Wait until the roller can be stepped and is heard."""
        self.spin_until(
            lambda: (
                self._advance.service_is_ready()
                and self._node.count_publishers("truth")
                and self._node.count_publishers("drum/acceleration")
            ),
            "the roller",
        )
        # Active is a little later than there.
        self.spin_until(lambda: self._step(1), "the first step")

    def step(self, revolutions: int) -> int:
        """Step, take all that comes of it, and return the index of the next sample."""
        response = self._step(revolutions)
        if response is None:
            raise SoakError("the roller refuses to step")
        expected = int(response.next_sample)
        self.spin_until(lambda: self.truth.next_sample >= expected, f"sample {expected}")
        return expected

    def _step(self, revolutions: int) -> Any:
        future = self._advance.call_async(Advance.Request(revolutions=revolutions))
        self.spin_until(future.done, "the answer to a step")
        response = future.result()
        return response if response.result.result == Result.RESULT_OK else None

    def _check(self) -> None:
        if not self._going_on():
            raise SoakError("the roller's process ended")
