# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Records without ever delaying the thread that hands the messages over: a process of its own writes."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO, cast

from roller_sim_ros.traces.errors import Problem, TraceError
from roller_sim_ros.traces.ring import CAPACITY, Kind, Ring, State
from roller_sim_ros.traces.writer import FLUSH_PERIOD_S

START_TIMEOUT_S = 15.0
CLOSE_TIMEOUT_S = 1.8

ROOM_S = 0.5e-3
"""How long a message that may wait does so before it tries again."""

_BLOCKED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


@dataclass(frozen=True)
class RecorderStatus:
    """How the recording is doing.

    Attributes
    ----------
    state : State
        RECORDING, FAILED or CLOSED.
    reason : str
        Why it failed, and the way out; else empty.
    messages, messages_written : int
        Taken by the recording process, and of those in the file in whole chunks (after a failure: at least).
    bytes_written : int
        Size of the file.
    dropped : mapping
        By topic, how many messages were refused: the ring was full, or the recording had failed or ended.
    lost : int
        Messages at most that were handed over, but are not in the file because the recording failed.
    """

    state: State
    reason: str
    messages: int
    messages_written: int
    bytes_written: int
    dropped: Mapping[str, int]
    lost: int


class _Channel:
    """A topic: its number, how many messages came and how many of them were dropped."""

    __slots__ = ("dropped", "number", "sequence", "unannounced")

    def __init__(self, number: int, unannounced: bytes) -> None:
        self.number = number
        self.sequence = 0
        self.dropped = 0
        self.unannounced = unannounced


class Recorder:
    """A recording; safe to use from several threads.

    Parameters
    ----------
    path : pathlib.Path
        The file.
    metadata : mapping
        Metadata records by name, as `roller_sim_ros.traces.metadata.run_metadata` makes them.
    overwrite : bool
        Replace a file that is there.
    flush_period_s : float
        What is older than this is in the file and survives a SIGKILL of both processes.
    capacity : int
        Bytes that the hand-over holds while the disk is slow.
    patience_s : float
        How long a message may wait for room in the hand-over before it is dropped: 0 where time does not wait.

    Raises
    ------
    TraceError
        If the file cannot be made. Later errors are in `status`.
    """

    def __init__(
        self,
        path: Path,
        metadata: Mapping[str, Mapping[str, str]],
        *,
        overwrite: bool = False,
        flush_period_s: float = FLUSH_PERIOD_S,
        capacity: int = CAPACITY,
        patience_s: float = 0.0,
    ) -> None:
        self.path = path
        self._patience_s = patience_s
        self._lock = threading.Lock()
        self._channels: dict[str, _Channel] = {}
        self._failure = ""
        self._open = True
        task = {
            "path": str(path),
            "metadata": {name: dict(record) for name, record in metadata.items()},
            "overwrite": overwrite,
            "flush_period_s": flush_period_s,
        }
        try:
            descriptor = Ring.create(capacity)
        except OSError as error:
            raise TraceError(
                path,
                Problem.UNWRITABLE,
                f"no {capacity} bytes of shared memory for the recording",
                "free memory or record elsewhere",
            ) from error
        try:
            self._ring = Ring(descriptor)
            self._process = _start(descriptor)
            # Its end, however it comes about, tells the recording process to finish the file.
            self._lifeline = cast("IO[bytes]", self._process.stdin)
            self._answers = cast("IO[bytes]", self._process.stdout)
            self._begin({**task, "ring": descriptor})
        finally:
            os.close(descriptor)

    def register(
        self,
        topic: str,
        type_name: str,
        schema_text: str,
        offered_qos_profiles: str,
        type_hash: str = "",
    ) -> None:
        """Announce a topic, at any time; see `roller_sim_ros.traces.writer.TraceWriter.register`."""
        announcement = {
            "topic": topic,
            "type_name": type_name,
            "schema_text": schema_text,
            "offered_qos_profiles": offered_qos_profiles,
            "type_hash": type_hash,
        }
        text = json.dumps(announcement).encode()
        with self._lock:
            if topic in self._channels:
                return
            channel = _Channel(len(self._channels), text)
            self._channels[topic] = channel
            self._announce(channel)

    def put(
        self, topic: str, data: bytes | memoryview, log_time_ns: int, publish_time_ns: int
    ) -> bool:
        """Hand a message over; waits for the other process only where the recorder has patience.

        Parameters
        ----------
        topic : str
            A registered topic.
        data : bytes
            CDR.
        log_time_ns, publish_time_ns : int
            When it was received and published, ns since the epoch.

        Returns
        -------
        bool
            False: it was dropped, and counted.
        """
        channel = self._channels[topic]
        with self._lock:
            # Dropped messages count too: the gap in the sequence is then in the file.
            channel.sequence += 1
            if (
                self._open
                and self._ring.recording
                and (not channel.unannounced or self._announce(channel))
                and self._push(Kind.MESSAGE, channel, (log_time_ns, publish_time_ns), data)
            ):
                return True
            channel.dropped += 1
            return False

    def status(self) -> RecorderStatus:
        """Return how the recording is doing; cheap, but meant for once a second."""
        ended = self._process.poll() is not None
        report = self._ring.report()
        if not self._failure and report.state is State.FAILED:
            self._failure = report.reason
        if not self._failure and ended and report.state is not State.CLOSED:
            self._failure = (
                f"{self.path}: the recording process ended unasked ({self._process.returncode}); "
                "roller-sim recover makes a whole file of what it left"
            )
        channels = list(self._channels.items())
        handed_over = sum(channel.sequence - channel.dropped for _, channel in channels)
        return RecorderStatus(
            state=State.FAILED if self._failure else report.state,
            reason=self._failure,
            messages=report.messages,
            messages_written=report.messages_written,
            bytes_written=report.bytes_written,
            dropped={name: channel.dropped for name, channel in channels},
            lost=max(0, handed_over - report.messages_written) if self._failure else 0,
        )

    def close(self, timeout_s: float = CLOSE_TIMEOUT_S) -> RecorderStatus:
        """Finish the file and return the last status; twice is the same as once.

        A recording process that is not done within `timeout_s` is left to finish by itself; the status
        is then FAILED with that reason.
        """
        with self._lock:
            self._open = False
        self._lifeline.close()
        try:
            self._process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            self._failure = (
                f"{self.path}: the recording was not finished within {timeout_s:g} s; its process "
                f"{self._process.pid} goes on by itself"
            )
        return self.status()

    def _push(
        self,
        kind: Kind,
        channel: _Channel,
        times_ns: tuple[int, int],
        data: bytes | memoryview,
    ) -> bool:
        """Put something into the ring, as soon as there is room if that is soon enough."""
        number, sequence = channel.number, channel.sequence if kind is Kind.MESSAGE else 0
        if self._ring.push(kind, number, sequence, *times_ns, data):
            return True
        deadline = time.monotonic() + self._patience_s
        while time.monotonic() < deadline and self._process.poll() is None and self._ring.recording:
            time.sleep(ROOM_S)
            if self._ring.push(kind, number, sequence, *times_ns, data):
                return True
        return False

    def _announce(self, channel: _Channel) -> bool:
        if not self._push(Kind.CHANNEL, channel, (0, 0), channel.unannounced):
            return False
        channel.unannounced = b""
        return True

    def _begin(self, task: Mapping[str, object]) -> None:
        """Hand the task over and wait until the file is begun."""
        answer = b""
        try:
            self._lifeline.write(json.dumps(task).encode() + b"\n")
            answer = _line(self._answers.fileno(), START_TIMEOUT_S)
        except BrokenPipeError:
            pass  # the process is gone already: no answer
        finally:
            self._answers.close()
        if answer == b"{}\n":
            return
        self._lifeline.close()
        self._process.kill()
        self._process.wait()
        if not answer.endswith(b"\n"):
            raise TraceError(
                self.path,
                Problem.UNWRITABLE,
                "the recording process did not start",
                "it may have said more on standard error",
            )
        error = json.loads(answer)
        raise TraceError(self.path, Problem[error["problem"]], error["reason"], error["way_out"])


def _start(descriptor: int) -> subprocess.Popen[bytes]:
    """Start the recording process; the signals that end this one are blocked there for good."""
    # The same import path as here, wherever this package and its dependencies came from.
    program = (
        f"import sys; sys.path[:] = {sys.path!r}; "
        "from roller_sim_ros.traces.recording_process import main; sys.exit(main())"
    )
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _BLOCKED)
    try:
        return subprocess.Popen(
            [sys.executable, "-c", program],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            pass_fds=(descriptor,),
        )
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _line(descriptor: int, timeout_s: float) -> bytes:
    """Return what comes until the end of a line, of the stream, or of the time."""
    line = b""
    deadline = time.monotonic() + timeout_s
    while not line.endswith(b"\n"):
        if not select.select([descriptor], [], [], max(0.0, deadline - time.monotonic()))[0]:
            break
        more = os.read(descriptor, 4096)
        if not more:
            break
        line += more
    return line
