# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The process that writes the trace: it empties the ring until the other end of its standard input closes.

It is started by `roller_sim_ros.traces.recorder`. The other end closes when the recorder is closed and
when its process ends in whatever way; both times the file is finished. The recorder starts this process with
those signals blocked that end itself.
"""

from __future__ import annotations

import json
import os
import select
import sys
import time
from pathlib import Path

from roller_sim_ros.traces.errors import TraceError
from roller_sim_ros.traces.ring import Kind, Ring, State
from roller_sim_ros.traces.writer import TraceWriter

PERIOD_S = 0.02
"""How often the ring is emptied."""

_STORES_ARRIVE_S = 0.002


def main() -> int:
    """Read the task from standard input (a line of JSON), answer on standard output, then record."""
    task = json.loads(sys.stdin.buffer.readline())
    ring = Ring(task["ring"])
    try:
        writer = TraceWriter(
            Path(task["path"]),
            task["metadata"],
            overwrite=task["overwrite"],
            flush_period_s=task["flush_period_s"],
        )
    except TraceError as error:
        _answer({"problem": error.problem.name, "reason": error.reason, "way_out": error.way_out})
        return 1
    ring.set_state(State.RECORDING)
    _answer({})
    try:
        _record(ring, writer)
    except TraceError as error:
        ring.set_counts(writer.messages, writer.messages_written, writer.bytes_written)
        ring.set_state(State.FAILED, str(error))
        return 1
    except BaseException as error:
        ring.set_state(State.FAILED, f"{task['path']}: the recording process failed: {error!r}")
        raise
    ring.set_counts(writer.messages, writer.messages_written, writer.bytes_written)
    ring.set_state(State.CLOSED)
    return 0


def _record(ring: Ring, writer: TraceWriter) -> None:
    topics: dict[int, str] = {}
    head = ring.head
    ended = False
    while not ended:
        ended = bool(select.select([0], [], [], PERIOD_S)[0])
        if ended:
            time.sleep(_STORES_ARRIVE_S)
            head = ring.head
        _take(ring, head, writer, topics)
        writer.flush_if_due()
        ring.set_counts(writer.messages, writer.messages_written, writer.bytes_written)
        head = ring.head
    writer.close()


def _take(ring: Ring, head: int, writer: TraceWriter, topics: dict[int, str]) -> None:
    for record in ring.drain(head):
        if record.kind == Kind.CHANNEL:
            channel = json.loads(record.data)
            writer.register(**channel)
            topics[record.channel] = channel["topic"]
        else:
            writer.put(
                topics[record.channel],
                record.data,
                record.log_time_ns,
                record.publish_time_ns,
                record.sequence,
            )


def _answer(answer: dict[str, str]) -> None:
    os.write(1, json.dumps(answer).encode() + b"\n")
