# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The hand-over to the recording process: a ring in shared memory that one side fills and the other empties.

Putting a message in is a copy in memory: no system call, no lock of the other process, nothing that could wait
or give the interpreter lock away. What is in the ring outlives the process that put it there. A full ring refuses.
"""

from __future__ import annotations

import mmap
import os
import struct
from collections.abc import Iterator
from enum import IntEnum
from typing import NamedTuple

CAPACITY = 16 * 1024 * 1024
"""Bytes; 10 s of everything with the IMU at every sample, over a minute of the rest."""

_HEADER = 4096
_HEAD, _TAIL, _STATE, _TAKEN, _WRITTEN, _SIZE, _REASON_LENGTH = range(7)
_REASON_AT, _REASON_MOST = 256, 2048

# length, kind, channel, sequence, (padding), log time, publish time
_RECORD = struct.Struct("<IHHIxxxxQQ")


class Kind(IntEnum):
    """What a record in the ring is."""

    SKIP = 0
    """Nothing; the next record is at the beginning of the ring."""
    CHANNEL = 1
    MESSAGE = 2


class State(IntEnum):
    """What the recording process says of itself."""

    STARTING = 0
    RECORDING = 1
    FAILED = 2
    CLOSED = 3


class Record(NamedTuple):
    """What was handed over."""

    kind: int
    channel: int
    sequence: int
    log_time_ns: int
    publish_time_ns: int
    data: bytes


class Report(NamedTuple):
    """What the recording process tells back."""

    state: State
    messages: int
    messages_written: int
    bytes_written: int
    reason: str


class Ring:
    """One producer process, one consumer process; threads of the producer must take turns.

    Parameters
    ----------
    descriptor : int
        Of the shared memory; the ring does not close it.
    """

    def __init__(self, descriptor: int) -> None:
        self._map = mmap.mmap(descriptor, 0)
        self._bytes = memoryview(self._map)
        # Native 64-bit words: Python stores each in one go, so the other side never sees half of one.
        self._words = self._bytes[:_REASON_AT].cast("Q")
        self._capacity = len(self._map) - _HEADER
        self._head = self._words[_HEAD]

    @staticmethod
    def create(capacity: int = CAPACITY) -> int:
        """Return the descriptor of a new, empty ring; raises OSError when there is no memory."""
        descriptor = os.memfd_create("roller_sim_ros recording")
        try:
            os.posix_fallocate(descriptor, 0, _HEADER + capacity // 8 * 8)
        except OSError:
            os.close(descriptor)
            raise
        return descriptor

    def push(
        self,
        kind: int,
        channel: int,
        sequence: int,
        log_time_ns: int,
        publish_time_ns: int,
        data: bytes | memoryview,
    ) -> bool:
        """Put a record in, or return False because there is no room."""
        length = len(data)
        size = (_RECORD.size + length + 7) & ~7
        head = self._head
        position = head % self._capacity
        room = self._capacity - position
        wraps = size > room
        needed = room + size if wraps else size
        if needed > self._capacity - (head - self._words[_TAIL]):
            return False
        if wraps:
            if room >= _RECORD.size:
                _RECORD.pack_into(self._bytes, _HEADER + position, 0, Kind.SKIP, 0, 0, 0, 0)
            position = 0
        start = _HEADER + position
        _RECORD.pack_into(
            self._bytes, start, length, kind, channel, sequence, log_time_ns, publish_time_ns
        )
        start += _RECORD.size
        self._bytes[start : start + length] = data
        self._head = head + needed
        self._words[_HEAD] = self._head
        return True

    @property
    def recording(self) -> bool:
        """Whether the recording process is at work, as far as it says."""
        return self._words[_STATE] == State.RECORDING

    @property
    def head(self) -> int:
        """Where the producer is; to the consumer `drain` may go so far."""
        return self._words[_HEAD]

    def drain(self, head: int) -> Iterator[Record]:
        """Take out all records before `head`.

        The consumer should have read `head` some time before: on machines that do not keep the order of
        stores the bytes before it may arrive a moment later than itself.
        """
        tail = self._words[_TAIL]
        while tail < head:
            position = tail % self._capacity
            room = self._capacity - position
            if room < _RECORD.size:
                tail += room
                continue
            start = _HEADER + position
            length, kind, channel, sequence, log_time_ns, publish_time_ns = _RECORD.unpack_from(
                self._bytes, start
            )
            if kind == Kind.SKIP:
                tail += room
                continue
            start += _RECORD.size
            data = bytes(self._bytes[start : start + length])
            record = Record(kind, channel, sequence, log_time_ns, publish_time_ns, data)
            tail += (_RECORD.size + length + 7) & ~7
            self._words[_TAIL] = tail
            yield record

    def report(self) -> Report:
        """Return what the recording process said last."""
        words = self._words
        state = State(words[_STATE])
        reason = b""
        if state is State.FAILED:
            reason = bytes(self._bytes[_REASON_AT : _REASON_AT + words[_REASON_LENGTH]])
        return Report(
            state, words[_TAKEN], words[_WRITTEN], words[_SIZE], reason.decode("utf-8", "replace")
        )

    def set_counts(self, messages: int, messages_written: int, bytes_written: int) -> None:
        """Tell the producer how far the recording is."""
        words = self._words
        words[_TAKEN], words[_WRITTEN], words[_SIZE] = messages, messages_written, bytes_written

    def set_state(self, state: State, reason: str = "") -> None:
        """Tell the producer what the recording process is doing; the reason goes with FAILED."""
        text = reason.encode("utf-8")[:_REASON_MOST]
        self._bytes[_REASON_AT : _REASON_AT + len(text)] = text
        self._words[_REASON_LENGTH] = len(text)
        self._words[_STATE] = state
