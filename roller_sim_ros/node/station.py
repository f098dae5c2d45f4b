# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What connects a roller: its topics, the commands it hears, its recording, and ``/clock``."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from rclpy.node import Node
from rclpy.subscription import Subscription

from roller_sim_ros.node.beginning import Beginning
from roller_sim_ros.node.clock_owner import ClockOwner
from roller_sim_ros.node.interfaces import message_type
from roller_sim_ros.node.outlet import Outlet
from roller_sim_ros.node.qos import overridable, overrides_of, profile
from roller_sim_ros.node.recording import Recording, receiver
from roller_sim_ros.node.report import RecordingReport
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.wire import messages, topics
from roller_sim_ros.wire.messages import Message

CLOSE_S = 1.5
"""How long the end of the node waits for the recording to be finished."""
CLOSE_SIMULATED_S = 60.0
"""The same in simulated time, which may have gone faster than the disk."""


class Station:
    """Topics are opened and closed as the node is configured and cleaned up; the recording may outlast them.

    Parameters
    ----------
    node : rclpy.node.Node
        The node.
    commands : mapping
        {topic: who takes the bytes of its messages}.
    now_ns : callable
        The time that messages and recordings are stamped with, ns.

    Attributes
    ----------
    outlet : Outlet or None
        Where messages leave; none while nothing is open.
    last_recording : RecordingReport or None
        What became of the last recording that was closed.
    """

    def __init__(
        self,
        node: Node,
        commands: Mapping[topics.Topic, Callable[[bytes], None]],
        now_ns: Callable[[], int],
    ) -> None:
        self.outlet: Outlet | None = None
        self.last_recording: RecordingReport | None = None
        self._node = node
        self._takers = dict(commands)
        self._now_ns = now_ns
        self._commands: dict[str, topics.Topic] = {}
        self._subscriptions: list[Subscription[Any]] = []
        self._clock: ClockOwner | None = None
        self._recording: Recording | None = None
        self._recordings = 0
        self._simulated = False
        self._unsent = 0

    def open(self, beginning: Beginning) -> Outlet:
        """Open the topics, and the recording that is asked for unless it is open.

        Raises
        ------
        RollerSimError
            If a quality of service or the recording cannot be; the caller closes what is open.
        """
        configuration = beginning.configuration
        self._simulated = configuration.pacing.simulated_time
        now_ns = self._now_ns if self._simulated else None
        self.outlet = Outlet(self._node, configuration.pacing, now_ns or time.time_ns)
        self._clock = ClockOwner(self._node, owns=self.publishes_clock)
        for topic, take in self._takers.items():
            self._subscribe(topic, take, configuration, now_ns)
        self._open_recording(beginning)
        return self.outlet

    def record(
        self, beginning: Beginning, between_blocks: Callable[..., None], begin: Callable[[], bool]
    ) -> None:
        """Record to the file that the parameters name from now on, or to none.

        Parameters
        ----------
        beginning : Beginning
            With these parameters.
        between_blocks : callable
            Does what it is given while nothing is sent.
        begin : callable
            Called then, before the first message goes to a new file; returns whether a run goes on.

        Raises
        ------
        RollerSimError
            If it cannot be begun; all is as before then.
        """
        assert self.outlet is not None  # topics are open
        outlet, before = self.outlet, self._recording
        path = beginning.configuration.recording.path
        after = self._recording_of(beginning, path) if path else None

        def turn() -> None:
            outlet.trace = None
            if after is not None:
                after.used = begin()
                after.attach(outlet)

        between_blocks(turn)
        self._recording, self._recordings = after, int(self._simulated)
        self._finish(before)

    def begin_run(self, beginning: Beginning) -> None:
        """Make ready for a run that begins: in simulated time every one has a recording of its own.

        Raises
        ------
        RollerSimError
            If its recording cannot be begun.
        """
        if self._simulated and self._recording is not None and self._recording.used:
            # Time jumps back, which a trace does not.
            self.close_recording()
            self._open_recording(beginning)
        if self._recording is not None:
            self._recording.used = True

    @property
    def publishes_clock(self) -> bool:
        """Whether there is a ``/clock`` of this node."""
        return self.outlet is not None and topics.CLOCK.name in self.outlet.publishers

    @property
    def rivals(self) -> tuple[str, ...]:
        """Nodes that publish ``/clock`` beside this one, as of the last look."""
        return self._clock.rivals if self._clock is not None else ()

    def send(self, message: Message) -> None:
        """Send a message, if topics are open."""
        if self.outlet is not None:
            self.outlet.send([message])

    def announce_clock(self) -> None:
        """Tell the time again, to those who come while it stands still."""
        if self.outlet is not None:
            self.outlet.announce(messages.clock(self._now_ns()))

    def look_for_topics(self) -> None:
        """Look for others' topics that are to be recorded."""
        if self._recording is not None:
            self._recording.look_for_topics()

    def look_for_rivals(self) -> None:
        """Look for others that publish ``/clock``."""
        if self._clock is not None:
            self._clock.look()

    def unsent(self) -> tuple[int, int]:
        """Return the messages that could not be sent since the topics were opened, and since the last call."""
        total = self.outlet.unsent if self.outlet is not None else 0
        before, self._unsent = self._unsent, total
        if total > before:
            self._node.get_logger().error(f"{total - before} messages could not be sent")
        return total, max(0, total - before)

    def recording_report(self) -> RecordingReport | None:
        """Return how the recording is doing, if there is one."""
        return self._recording.report() if self._recording is not None else None

    def close_recording(self) -> None:
        """Finish the recording."""
        if self.outlet is not None:
            self.outlet.trace = None
        recording, self._recording = self._recording, None
        self._finish(recording)

    def close_topics(self) -> None:
        """Close the topics; the recording stays."""
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()
        self._commands.clear()
        if self.outlet is not None:
            self.outlet.destroy()
            self.outlet = None
            self._unsent = 0

    def _finish(self, recording: Recording | None) -> None:
        if recording is not None:
            recording.close(CLOSE_SIMULATED_S if self._simulated else CLOSE_S)
            self.last_recording = recording.report()

    def _subscribe(
        self,
        topic: topics.Topic,
        take: Callable[[bytes], None],
        configuration: Configuration,
        now_ns: Callable[[], int] | None,
    ) -> None:
        name = self._node.resolve_topic_name(topic.name)

        def put(data: bytes, received_ns: int, published_ns: int) -> None:
            if self._recording is not None:
                self._recording.put_command(name, data, received_ns, published_ns)
            take(data)

        with overrides_of(topic):
            subscription = self._node.create_subscription(
                message_type(topic.type_name),
                topic.name,
                receiver(put, now_ns),
                profile(topic.qos(configuration.pacing)),
                raw=True,
                qos_overriding_options=overridable(),
            )
        self._subscriptions.append(subscription)
        self._commands[name] = topic

    def _open_recording(self, beginning: Beginning) -> None:
        """Begin the recording that the parameters ask for, or go on with the one that is open."""
        assert self.outlet is not None  # the caller opened it
        wanted = beginning.configuration.recording
        if self._recording is not None and self._recording.parameters == wanted:
            self._recording.register_topics(self.outlet)
            self._recording.attach(self.outlet)
            return
        self.close_recording()
        if wanted.path:
            path = _numbered(wanted.path, self._recordings)
            self._recording = self._recording_of(beginning, path)
            self._recording.attach(self.outlet)
            self._recordings += self._simulated

    def _recording_of(self, beginning: Beginning, path: str) -> Recording:
        assert self.outlet is not None  # the caller opened it
        return Recording(
            self._node,
            self.outlet,
            self._commands,
            beginning.configuration,
            beginning.metadata(self._now_ns()),
            path,
            self._now_ns if self._simulated else None,
        )


def _numbered(path: str, before: int) -> str:
    """Return the file of a run: as asked for, and with a number for those after the first."""
    if not before:
        return path
    first = Path(path)
    return str(first.with_name(f"{first.stem}-{before + 1}{first.suffix}"))
