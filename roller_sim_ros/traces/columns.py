# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Messages of a trace by the chunk, as arrays: what makes hours of trace readable in seconds.

A chunk's message index tells where each message stands, so that chunks without wanted topics are not even
decompressed, and fields of messages alike are gathered by numpy without a loop over messages.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel, Schema
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype

from roller_sim_ros.traces.bag import trace_files
from roller_sim_ros.traces.contents import ChannelTable, read_contents
from roller_sim_ros.traces.frames import FrameReader, open_trace
from roller_sim_ros.traces.records import UNREADABLE, whole_chunk

_INDEX_HEAD = struct.Struct("<HI")
_INDEX_ENTRY = np.dtype([("time", "<u8"), ("offset", "<u8")])
_RECORD_HEAD = 9
"""Bytes of a record before its content: kind and length."""
_MESSAGE_HEAD = 22
"""Bytes of a message record's content before the message: channel, sequence, two times."""
_ENCAPSULATION = 4
"""Bytes of CDR before the first field; alignment counts from after them."""

Indexes = dict[int, NDArray[Any]]


class Messages(NamedTuple):
    """Messages of one topic in one chunk.

    Attributes
    ----------
    data : ndarray of uint8
        All bytes of the chunk.
    starts, lengths : ndarray of int64, shape (n,)
        Where the CDR bytes of each message begin, and how many they are.
    log_time_ns : ndarray of uint64, shape (n,)
        When each was received.
    """

    data: NDArray[np.uint8]
    starts: NDArray[np.int64]
    lengths: NDArray[np.int64]
    log_time_ns: NDArray[np.uint64]

    def chosen(self, which: NDArray[np.bool_] | NDArray[np.int64]) -> Messages:
        """Return some of them, by a mask or by their numbers."""
        return self._replace(
            starts=self.starts[which],
            lengths=self.lengths[which],
            log_time_ns=self.log_time_ns[which],
        )

    def bytes_of(self, number: int) -> bytes:
        """Return the CDR bytes of one."""
        start = self.starts[number]
        return self.data[start : start + self.lengths[number]].tobytes()


def read_messages(
    path: Path,
    topics: Collection[str],
    progress: Callable[[float], None] = lambda _share: None,
    between: Collection[tuple[int, int]] | None = None,
) -> Iterator[dict[str, Messages]]:
    """Yield the messages of some topics, chunk by chunk in the order of the file.

    What is damaged, or stands outside of chunks or in chunks without index, is left out: `TraceReader` reads that.

    Parameters
    ----------
    path : Path
        MCAP file or rosbag2 folder.
    topics : collection of str
        Absolute names.
    progress : callable
        Told the share of the bytes that is read.
    between : collection of (int, int), optional
        Log times, ns since the epoch; only chunks with some between two of a pair are read.

    Raises
    ------
    TraceError
        If there is no such trace or it cannot be opened.
    """
    files = trace_files(path)
    size = max(1, sum(file.stat().st_size for file in files))
    before = 0
    for file in files:
        table = read_contents(file).table
        for position, content, indexes in _chunks(file, table):
            progress((before + position) / size)
            wanted = {
                number: index
                for number, index in indexes.items()
                if number in table.channels
                and table.channels[number].topic in topics
                and (between is None or _touches(index["time"], between))
            }
            if wanted:
                try:
                    data = np.frombuffer(whole_chunk(content), dtype=np.uint8)
                    yield {
                        table.channels[number].topic: _messages(data, index)
                        for number, index in wanted.items()
                    }
                except UNREADABLE:
                    continue
        before += file.stat().st_size
    progress(1.0)


def _chunks(path: Path, table: ChannelTable) -> Iterator[tuple[int, bytes, Indexes]]:
    """Yield where each chunk ends, its content as it stands, and its indexes by channel."""
    chunk, indexes = b"", dict[int, NDArray[Any]]()
    with open_trace(path) as stream:
        frames = FrameReader(stream, path.stat().st_size)
        for frame in frames:
            if frame.opcode == Opcode.MESSAGE_INDEX:
                if len(frame.content) >= _INDEX_HEAD.size:
                    number, length = _INDEX_HEAD.unpack_from(frame.content)
                    count = (
                        min(length, len(frame.content) - _INDEX_HEAD.size) // _INDEX_ENTRY.itemsize
                    )
                    indexes[number] = np.frombuffer(
                        frame.content, _INDEX_ENTRY, count, _INDEX_HEAD.size
                    )
                continue
            if chunk and indexes:
                yield frames.position, chunk, indexes
            chunk, indexes = b"", {}
            if frame.opcode == Opcode.CHUNK:
                chunk = frame.content
            elif frame.opcode == Opcode.SCHEMA:
                table.take(Schema.read(ReadDataStream(BytesIO(frame.content))))
            elif frame.opcode == Opcode.CHANNEL:
                table.take(Channel.read(ReadDataStream(BytesIO(frame.content))))
    if chunk and indexes:
        yield frames.position, chunk, indexes


def _touches(times_ns: NDArray[np.uint64], between: Collection[tuple[int, int]]) -> bool:
    if not len(times_ns):
        return False
    first, last = int(times_ns.min()), int(times_ns.max())
    return any(first <= end and last >= start for start, end in between)


def _messages(data: NDArray[np.uint8], index: NDArray[Any]) -> Messages:
    records = index["offset"].astype(np.int64)
    if len(records) and (
        records.min() < 0 or records.max() + _RECORD_HEAD + _MESSAGE_HEAD > len(data)
    ):
        raise ValueError("the index of a chunk points out of it")
    lengths = gather(data, records + 1, np.dtype("<i8"), 1)[:, 0] - _MESSAGE_HEAD
    starts = records + _RECORD_HEAD + _MESSAGE_HEAD
    if len(records) and (lengths.min() < _ENCAPSULATION or (starts + lengths).max() > len(data)):
        raise ValueError("a message of a chunk reaches out of it")
    return Messages(data, starts, lengths, index["time"])


def gather(
    data: NDArray[np.uint8], starts: NDArray[np.int64], dtype: np.dtype[Any], count: int
) -> NDArray[Any]:
    """Return `count` values of a type from each start; shape (starts, count)."""
    width = dtype.itemsize * count
    if not len(starts) or not count:
        return np.empty((len(starts), count), dtype)
    windows = np.lib.stride_tricks.sliding_window_view(data, width)
    return np.ascontiguousarray(windows[starts]).view(dtype)


@dataclass(frozen=True)
class _Place:
    offset: int
    dtype: np.dtype[Any]
    count: int
    scalar: bool


class Layout:
    """Where the fields of a message stand that is like another: texts and arrays of the same lengths.

    Parameters
    ----------
    definitions : mapping
        ``fielddefs`` of a rosbags type store that knows the type.
    type_name : str
        As in ``package/msg/Name``.
    sample : bytes
        CDR of such a message, little endian.
    """

    def __init__(self, definitions: Mapping[str, Any], type_name: str, sample: bytes) -> None:
        self._definitions = definitions
        self._sample = sample
        self._places: dict[str, _Place] = {}
        self._guards: list[int] = []
        self._end = self._walk(type_name, "", 0)
        self._lengths = {guard: self._word(guard) for guard in self._guards}

    def alike(self, messages: Messages) -> NDArray[np.bool_]:
        """Return which messages have this layout."""
        same: NDArray[np.bool_] = messages.lengths == len(self._sample)
        for guard, length in self._lengths.items():
            starts = np.where(same, messages.starts, messages.starts[:1]) + _ENCAPSULATION + guard
            # Of one that is shorter nothing is read: it is compared with itself, and out already.
            starts = np.minimum(starts, len(messages.data) - 4)
            same &= gather(messages.data, starts, np.dtype("<u4"), 1)[:, 0] == length
        return same

    def field(self, messages: Messages, name: str) -> NDArray[Any]:
        """Return a field of messages that are alike: shape (n,), of an array (n, length).

        Parameters
        ----------
        messages : Messages
            Of this layout.
        name : str
            As in ``header.stamp.sec``; a number or an array of numbers.
        """
        place = self._places[name]
        starts = messages.starts + _ENCAPSULATION + place.offset
        values = gather(messages.data, starts, place.dtype, place.count)
        return values[:, 0] if place.scalar else values

    def _walk(self, type_name: str, prefix: str, at: int) -> int:
        for name, (kind, detail) in self._definitions[type_name][1]:
            at = self._place(f"{prefix}{name}", kind, detail, at)
        return at

    def _place(self, name: str, kind: Nodetype, detail: Any, at: int) -> int:
        if kind is Nodetype.BASE:
            return self._base(name, detail[0], at, 1, scalar=True)
        if kind is Nodetype.NAME:
            return self._walk(detail, f"{name}.", at)
        count = int(detail[1])
        if kind is Nodetype.SEQUENCE:
            at += -at % 4
            self._guards.append(at)
            count, at = self._word(at), at + 4
        inner, of = detail[0]
        if inner is Nodetype.BASE:
            return self._base(name, of[0], at, count, scalar=False)
        for number in range(count):
            at = self._place(f"{name}[{number}]", inner, of, at)
        return at

    def _base(self, name: str, base: str, at: int, count: int, *, scalar: bool) -> int:
        if base == "string":
            for _ in range(count):
                at += -at % 4
                self._guards.append(at)
                at += 4 + self._word(at)
            return at
        kind = {"bool": "u1", "octet": "u1", "char": "u1"}.get(base, base)
        dtype: np.dtype[Any] = np.dtype(kind).newbyteorder("<")
        if count:
            at += -at % dtype.itemsize
            self._places[name] = _Place(at, dtype, count, scalar)
        else:
            self._places[name] = _Place(0, dtype, 0, scalar)
        return at + int(dtype.itemsize) * count

    def _word(self, at: int) -> int:
        return int(struct.unpack_from("<I", self._sample, _ENCAPSULATION + at)[0])
