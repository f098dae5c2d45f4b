# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a trace holds, record by record, whatever state the file is in."""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path
from typing import NamedTuple

import lz4.frame  # type: ignore[import-untyped]
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Footer, Header, Metadata, Schema, Statistics

from roller_sim_ros.traces.errors import reading_error
from roller_sim_ros.traces.frames import Damage, Frame, FrameReader, open_trace

_MESSAGE = struct.Struct("<HIQQ")
_FRAME = struct.Struct("<BQ")
_INDEX_HEAD = struct.Struct("<HI")
_INDEX_ENTRY = 16

_LARGEST_CHUNK = 4 * 2**30

UNREADABLE = (
    McapError,
    zstandard.ZstdError,
    struct.error,
    # lz4 raises RuntimeError; texts that are none and sizes that cannot be are the others.
    RuntimeError,
    ValueError,
    OverflowError,
    MemoryError,
)
"""What reading a damaged record may raise."""


class RawMessage(NamedTuple):
    """A message as it stands in the file."""

    channel_id: int
    sequence: int
    log_time_ns: int
    publish_time_ns: int
    data: bytes


Record = Header | Schema | Channel | RawMessage | Metadata | Attachment


class TraceRecords:
    """Iterates over the records of an MCAP file in the order of the file.

    Schemas and channels may come more than once. What cannot be used is left out and listed.

    Parameters
    ----------
    path : pathlib.Path
        The file.

    Attributes
    ----------
    damages : list of Damage
        What cannot be used, as far as read. Empty at the end: the file is whole.
    size, position : int
        Bytes of the file, and how many of them are read.
    salvaged : int
        Messages taken from a chunk that the end of the file cuts off.

    Raises
    ------
    TraceError
        On construction as `open_trace`; in the iteration if the system fails to read on.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._stream = open_trace(path)
        self.size = os.fstat(self._stream.fileno()).st_size
        self.damages: list[Damage] = []
        self.salvaged = 0
        self._messages = 0
        self._frames = FrameReader(self._stream, self.size)
        self._lost: Damage | None = None

    @property
    def position(self) -> int:
        """Bytes read so far."""
        return self._frames.position

    def close(self) -> None:
        """Close the file."""
        self._stream.close()

    def __enter__(self) -> TraceRecords:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __iter__(self) -> Iterator[Record]:
        try:
            yield from self._all()
        except OSError as error:
            raise reading_error(self.path, error) from error

    def _all(self) -> Iterator[Record]:
        for frame in self._frames:
            if frame.opcode == Opcode.MESSAGE_INDEX:
                self._count_lost(frame)
                continue
            self._lost = None
            try:
                records = list(self._read(frame))
            except UNREADABLE as error:
                what = _NAMES.get(frame.opcode, "a record")
                length = _FRAME.size + len(frame.content)
                self._lost = Damage(frame.offset, length, f"{what} is damaged: {error}")
                self.damages.append(self._lost)
                continue
            for record in records:
                self._messages += isinstance(record, RawMessage)
                yield record
        if self._frames.damage:
            yield from self._salvage()
            self.damages.append(self._frames.damage)

    def _read(self, frame: Frame) -> Iterator[Record]:
        opcode, content = frame.opcode, frame.content
        if opcode == Opcode.CHUNK:
            yield from _chunk_records(whole_chunk(content))
        elif opcode == Opcode.MESSAGE:
            yield RawMessage._make((*_MESSAGE.unpack_from(content), content[_MESSAGE.size :]))
        elif opcode == Opcode.FOOTER:
            self._check_summary(Footer.read(ReadDataStream(BytesIO(content))), frame.offset)
        elif opcode == Opcode.STATISTICS:
            self._check_statistics(Statistics.read(ReadDataStream(BytesIO(content))))
        elif opcode in _PLAIN:
            yield _PLAIN[opcode](ReadDataStream(BytesIO(content)))

    def _count_lost(self, index: Frame) -> None:
        """Add the messages of an index that follows a damaged chunk."""
        if self._lost and len(index.content) >= _INDEX_HEAD.size:
            _, length = _INDEX_HEAD.unpack_from(index.content)
            self._lost.messages += length // _INDEX_ENTRY

    def _check_statistics(self, statistics: Statistics) -> None:
        """Find losses that leave no other trace, as of a chunk whose kind has changed."""
        if not self.damages and statistics.message_count != self._messages:
            raise ValueError(
                f"it counts {statistics.message_count} messages in the file, there are {self._messages}"
            )

    def _check_summary(self, footer: Footer, offset: int) -> None:
        if not footer.summary_crc:
            return
        self._stream.seek(footer.summary_start)
        # All from the summary's first byte to the footer's checksum, which is its last field.
        checked = self._stream.read(offset + _FRAME.size + 16 - footer.summary_start)
        self._stream.seek(offset + _FRAME.size + 20)
        if zlib.crc32(checked) != footer.summary_crc:
            raise ValueError("the summary does not match its checksum")

    def _salvage(self) -> Iterator[Record]:
        """Yield the whole records of a chunk that the end of the file cuts off."""
        if not self._frames.cut_chunk:
            return
        try:
            for record in _chunk_records(_part_of_chunk(self._frames.cut_chunk)):
                self.salvaged += isinstance(record, RawMessage)
                yield record
        except UNREADABLE:
            return


_PLAIN: dict[int, Callable[[ReadDataStream], Record]] = {
    Opcode.HEADER: Header.read,
    Opcode.SCHEMA: Schema.read,
    Opcode.CHANNEL: Channel.read,
    Opcode.METADATA: Metadata.read,
    Opcode.ATTACHMENT: Attachment.read,
}


_NAMES: dict[int, str] = {
    Opcode.CHUNK: "a chunk",
    Opcode.STATISTICS: "the summary",
    Opcode.FOOTER: "the summary",
}


def whole_chunk(content: bytes) -> bytes:
    """Return the records of a chunk as they were before compression, checked."""
    chunk = Chunk.read(ReadDataStream(BytesIO(content)))
    if chunk.uncompressed_size > _LARGEST_CHUNK:
        raise ValueError(f"a size of {chunk.uncompressed_size} bytes")
    data: bytes
    if chunk.compression == "zstd":
        data = zstandard.decompress(chunk.data, chunk.uncompressed_size)
    elif chunk.compression == "lz4":
        data = lz4.frame.decompress(chunk.data)
    elif not chunk.compression:
        data = chunk.data
    else:
        raise ValueError(f"unknown compression {chunk.compression}")
    if len(data) != chunk.uncompressed_size:
        raise ValueError("it has not its size")
    if chunk.uncompressed_crc and zlib.crc32(data) != chunk.uncompressed_crc:
        raise ValueError("it does not match its checksum")
    return data


def _part_of_chunk(content: bytes) -> bytes:
    """Return what can be had of a chunk whose end is missing."""
    chunk = Chunk.read(ReadDataStream(BytesIO(content)))
    if chunk.compression == "zstd":
        return zstandard.ZstdDecompressor().decompressobj().decompress(chunk.data)
    if chunk.compression == "lz4":
        return bytes(lz4.frame.LZ4FrameDecompressor().decompress(chunk.data))
    return bytes(chunk.data)


def _chunk_records(data: bytes) -> Iterator[Record]:
    """Yield the records in a chunk, up to the first that is not there with all its bytes."""
    position, end = 0, len(data)
    while position + _FRAME.size <= end:
        opcode, length = _FRAME.unpack_from(data, position)
        position += _FRAME.size
        if position + length > end or opcode == 0:
            return
        if opcode == Opcode.MESSAGE:
            start = position + _MESSAGE.size
            yield RawMessage._make(
                (*_MESSAGE.unpack_from(data, position), data[start : position + length])
            )
        elif opcode in _PLAIN:
            yield _PLAIN[opcode](ReadDataStream(BytesIO(data[position : position + length])))
        position += length
