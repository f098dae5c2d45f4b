# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The page's place on the ROS 2 network: a node that listens, commands and calls; the only module here with ROS."""

from __future__ import annotations

import asyncio
import threading
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import rclpy
from rcl_interfaces.srv import DescribeParameters, SetParametersAtomically
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.msg import ExciterCommand
from roller_sim_ros.node.interfaces import message_type
from roller_sim_ros.node.qos import profile
from roller_sim_ros.parameters import Pacing, Value
from roller_sim_ros.srv import ClearFaults, InjectFault
from roller_sim_ros.wire import topics

NAME = "roller_panel"

DEPTH = 1000
"""Blocks that may wait for the executor."""
MOST_WAITING = 20_000
"""Messages that may wait to be looked at; the oldest fall out."""
PATIENCE_S = 10.0
"""How long an answer may take; a transition that compiles takes seconds."""
SPIN_S = 0.1

_BLOCKS = (topics.ACCELERATION, topics.TRUTH)

Limits = dict[str, tuple[float, float]]


class Client:
    """A node beside the roller; its executor runs in a thread of its own.

    Parameters
    ----------
    ros_arguments : sequence of str
        ``--ros-args`` and what follows.
    listened : sequence of Topic
        What is listened to.
    namespace : str
        Namespace of the roller.
    roller : str
        Name of the roller's node.

    Attributes
    ----------
    roller : str
        Fully qualified name of the roller's node.

    Raises
    ------
    RollerSimError
        If ROS 2 refuses the arguments or the namespace.
    """

    def __init__(
        self,
        ros_arguments: Sequence[str],
        listened: Sequence[topics.Topic],
        *,
        namespace: str,
        roller: str,
    ) -> None:
        self._context = Context()
        try:
            rclpy.init(args=list(ros_arguments), context=self._context)
            self._node = Node(NAME, context=self._context, namespace=namespace)
        except Exception as error:
            self._context.try_shutdown()
            reason = " ".join(str(error).split())
            raise RollerSimError(f"ROS 2 refuses its arguments: {reason}") from error
        self.roller = f"{self._node.get_namespace().rstrip('/')}/{roller}"
        self._waiting: deque[tuple[topics.Topic, bytes]] = deque(maxlen=MOST_WAITING)
        for topic in listened:
            self._listen(topic)
        depth = topics.EXCITER_COMMAND.depth(Pacing())
        self._commands = self._node.create_publisher(
            ExciterCommand, topics.EXCITER_COMMAND.name, depth
        )
        services: dict[str, type] = {
            "inject_fault": InjectFault,
            "clear_faults": ClearFaults,
            "release": Trigger,
            f"{roller}/set_parameters_atomically": SetParametersAtomically,
            f"{roller}/describe_parameters": DescribeParameters,
        }
        self._services: dict[str, Any] = {
            name.rpartition("/")[2]: self._node.create_client(kind, name)
            for name, kind in services.items()
        }
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._stopping = False
        self._thread = threading.Thread(target=self._spin, name="ros", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Leave the network."""
        self._stopping = True
        self._thread.join()
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()

    def received(self) -> list[tuple[topics.Topic, bytes]]:
        """Return what has come since the last call, the oldest first."""
        waiting = self._waiting
        return [waiting.popleft() for _ in range(len(waiting))]

    def command(self, *, vibrate: bool, frequency_hz: float, amplitude_m: float) -> None:
        """Publish an exciter command.

        Raises
        ------
        RollerSimError
            If nobody obeys commands.
        """
        if not self._commands.get_subscription_count():
            raise RollerSimError(f"{self.roller} does not listen to commands: it is not configured")
        message = ExciterCommand(vibrate=vibrate, frequency=frequency_hz, amplitude=amplitude_m)
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._commands.publish(message)

    async def limits(self, names: Sequence[str]) -> Limits:
        """Return {dotted name: (least, greatest)} of parameters as the roller states them."""
        response = await self._call("describe_parameters", names=list(names))
        limits: Limits = {}
        for item in response.descriptors:
            for bound in item.floating_point_range:
                limits[item.name] = (bound.from_value, bound.to_value)
        return limits

    async def set_parameters(self, values: Mapping[str, Value]) -> None:
        """Set parameters, all or none.

        Raises
        ------
        RollerSimError
            If the roller refuses, with its reason.
        """
        items = [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
        result = (await self._call("set_parameters_atomically", parameters=items)).result
        if not result.successful:
            raise RollerSimError(result.reason)

    async def inject(self, fault_id: str, duration_s: float) -> None:
        """Let a fault be active with its defaults, for a time or, with 0, until it is cleared."""
        self._done(await self._call("inject_fault", fault_id=fault_id, duration_s=duration_s))

    async def clear(self, handle: int) -> None:
        """End a fault, or with 0 all that were injected."""
        self._done(await self._call("clear_faults", handle=handle))

    async def release(self) -> None:
        """Hand exciter and travel back to the scenario."""
        self._done(await self._call("release"))

    async def record(self, path: str) -> None:
        """Record to a file from the next block on, or with an empty path to none."""
        await self.set_parameters({"recording.path": path})

    async def _call(self, name: str, **fields: Any) -> Any:
        client = self._services[name]
        if not client.service_is_ready():
            raise RollerSimError(f"{self.roller} offers no {name}: it does not run")
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[Any] = loop.create_future()

        def settle(response: Any) -> None:
            if not answer.done():
                answer.set_result(response)

        def done(future: Any) -> None:
            loop.call_soon_threadsafe(settle, future.result())

        future = client.call_async(client.srv_type.Request(**fields))
        future.add_done_callback(done)
        try:
            return await asyncio.wait_for(answer, PATIENCE_S)
        except asyncio.TimeoutError:
            client.remove_pending_request(future)
            raise RollerSimError(
                f"{self.roller} did not answer {name} within {PATIENCE_S:g} s"
            ) from None

    @staticmethod
    def _done(response: Any) -> None:
        if not response.success:
            raise RollerSimError(response.message)

    def _listen(self, topic: topics.Topic) -> None:
        qos = topic.qos(Pacing())
        if topic in _BLOCKS:
            # A page that is slow must not have the roller send again what it missed.
            qos = replace(qos, reliability="best_effort", depth=DEPTH)
        keep: Callable[[bytes], None] = lambda data: self._waiting.append((topic, data))  # noqa: E731
        self._node.create_subscription(
            message_type(topic.type_name), topic.name, keep, profile(qos), raw=True
        )

    def _spin(self) -> None:
        while not self._stopping:
            self._executor.spin_once(timeout_sec=SPIN_S)
