# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""MCAP's framing: which records of a file are there with all their bytes.

It is read here and not by the mcap library because every offset matters when a file is damaged; what is
inside the records the library reads.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, NamedTuple

from mcap.opcode import Opcode

from roller_sim_ros.traces.errors import Problem, TraceError, reading_error

MAGIC = b"\x89MCAP0\r\n"

_FRAME = struct.Struct("<BQ")

# What begins files that are taken for MCAP by mistake.
_OTHERS = {
    b"SQLite format 3\0": "it is a rosbag2 bag in SQLite, of which `ros2 bag convert` makes MCAP",
    b"#ROSBAG": "it is a bag of ROS 1, which `rosbags-convert` makes one of ROS 2",
    b"\x28\xb5\x2f\xfd": "it is compressed as a whole: `zstd -d` it first",
}


class Frame(NamedTuple):
    """A record that is there with all its bytes: its kind, where it begins and its content."""

    opcode: int
    offset: int
    content: bytes


@dataclass
class Damage:
    """A part of a file that cannot be used.

    Attributes
    ----------
    offset, length : int
        Where it is, in bytes.
    reason : str
        What is wrong.
    messages : int
        Messages known to be lost in it, as far as an index tells.
    """

    offset: int
    length: int
    reason: str
    messages: int = 0


def open_trace(path: Path) -> BinaryIO:
    """Open an MCAP file; its position is after the first magic bytes.

    Raises
    ------
    TraceError
        If there is no such file, it cannot be read, is empty or is something else.
    """
    try:
        stream = path.open("rb")
    except OSError as error:
        raise reading_error(path, error) from error
    try:
        head = stream.read(16)
        stream.seek(len(MAGIC))
    except OSError as error:
        stream.close()
        raise reading_error(path, error) from error
    if head.startswith(MAGIC):
        return stream
    stream.close()
    if not head:
        raise TraceError(path, Problem.EMPTY, "it is empty", "there is nothing to read in it")
    if MAGIC.startswith(head):
        reason = f"it ends after {len(head)} bytes"
        raise TraceError(path, Problem.EMPTY, reason, "there is nothing to read in it")
    for magic, way_out in _OTHERS.items():
        if head.startswith(magic):
            raise TraceError(path, Problem.FOREIGN, "it is no MCAP file", way_out)
    way_out = "give a .mcap file or the folder of a bag"
    raise TraceError(path, Problem.FOREIGN, "it is no MCAP file", way_out)


class FrameReader:
    """Iterates over whole records; stops after the footer, or where there is no whole record.

    Parameters
    ----------
    stream : BinaryIO
        As `open_trace` returns it.
    size : int
        Bytes of the file.

    Attributes
    ----------
    position : int
        Where the next record begins.
    damage : Damage or None
        Why it stopped before the end of a whole file.
    cut_chunk : bytes
        What is there of a chunk that the end of the file cuts off.
    """

    def __init__(self, stream: BinaryIO, size: int) -> None:
        self._stream = stream
        self._size = size
        self.position = stream.tell()
        self.damage: Damage | None = None
        self.cut_chunk = b""

    def __iter__(self) -> Iterator[Frame]:
        while True:
            head = self._stream.read(_FRAME.size)
            if len(head) < _FRAME.size:
                self._stop("the file ends without its last records")
                return
            opcode, length = _FRAME.unpack(head)
            if opcode == 0:
                self._stop("there are no records from here on")
                return
            if length > self._size - self.position - _FRAME.size:
                if opcode == Opcode.CHUNK:
                    self.cut_chunk = self._stream.read()
                self._stop("the last record is cut off")
                return
            frame = Frame(opcode, self.position, self._stream.read(length))
            self.position += _FRAME.size + length
            yield frame
            if opcode == Opcode.FOOTER:
                self._end()
                return

    def _end(self) -> None:
        if self._stream.read(len(MAGIC)) == MAGIC:
            self.position += len(MAGIC)
        else:
            self._stop("the file ends without its last bytes")

    def _stop(self, reason: str) -> None:
        self.damage = Damage(self.position, self._size - self.position, reason)
