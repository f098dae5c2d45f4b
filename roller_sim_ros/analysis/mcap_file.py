"""Reading an MCAP file front to back, also one that was cut off.

The mcap package's stream reader is used because it needs neither index nor footer: what is whole is read,
in the order of the file and in bounded memory. (Its indexed reader, and that of rosbags, refuse a file
that lacks its end.)
"""

from __future__ import annotations

import struct
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import IO, BinaryIO, cast

import zstandard
from mcap.exceptions import EndOfFile, McapError
from mcap.reader import SeekingReader
from mcap.records import Channel, Message, Schema
from mcap.stream_reader import StreamReader

from roller_sim_ros.analysis.bag import BagError, Received, Topic
from roller_sim_ros.analysis.decoding import Decoder

_DAMAGE = (McapError, ValueError, RuntimeError, EOFError, struct.error, zstandard.ZstdError)
_MAGIC = b"\x89MCAP0\r\n"
_SQLITE = b"SQLite f"


class McapFile:
    """An MCAP file.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    BagError
        If it is empty or no MCAP file.
    OSError
        If it cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.damage = ""
        self.progress = 0.0
        self.topics: dict[str, Topic] = {}
        self._decoder = Decoder()
        self._size = path.stat().st_size
        with path.open("rb") as file:
            start = file.read(len(_MAGIC))
            if not start:
                raise BagError(f"{path}: the file is empty")
            if start == _SQLITE:
                raise BagError(
                    f"{path}: is an SQLite file; give the rosbag2 folder that holds it and metadata.yaml"
                )
            if start != _MAGIC:
                raise BagError(f"{path}: is no MCAP file (it does not begin as one)")
            if not self._read_summary(file):
                self._scan(file)

    def messages(self, topics: Collection[str]) -> Iterator[Received]:
        """Yield the messages of some topics in the order of the file."""
        schemas: dict[int, Schema] = {}
        channels: dict[int, tuple[str, str]] = {}
        with self.path.open("rb") as file:
            for record in self._records(file):
                if isinstance(record, Message):
                    if record.channel_id in channels:
                        topic, name = channels[record.channel_id]
                        message = self._decoder.decode(record.data, name)
                        yield Received(topic, record.log_time, message)
                elif isinstance(record, Schema):
                    schemas[record.id] = record
                elif isinstance(record, Channel) and record.topic in topics:
                    channels[record.id] = (record.topic, self._add_type(record, schemas))

    def _add_type(self, channel: Channel, schemas: dict[int, Schema]) -> str:
        schema = schemas.get(channel.schema_id)
        if channel.message_encoding != "cdr" or schema is None or not _is_ros(schema):
            raise BagError(
                f"{self.path}: {channel.topic} is encoded as {channel.message_encoding!r} with a schema that "
                "is no ROS 2 definition"
            )
        idl = schema.encoding == "ros2idl"
        self._decoder.add(schema.name, schema.data.decode("utf-8", "replace"), idl=idl)
        return schema.name

    def _read_summary(self, file: BinaryIO) -> bool:
        """Fill `topics` from the file's own summary; return whether it has one."""
        try:
            summary = SeekingReader(file).get_summary()
        except _DAMAGE:
            return False
        if summary is None or summary.statistics is None:
            return False
        counts = summary.statistics.channel_message_counts
        for channel in summary.channels.values():
            self._add_topic(channel, summary.schemas, counts.get(channel.id, 0))
        return True

    def _scan(self, file: BinaryIO) -> None:
        """Fill `topics` by reading all of the file."""
        file.seek(0)
        schemas: dict[int, Schema] = {}
        channels: dict[int, Channel] = {}
        counts: dict[int, int] = {}
        for record in self._records(file):
            if isinstance(record, Message):
                counts[record.channel_id] = counts.get(record.channel_id, 0) + 1
            elif isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel):
                channels[record.id] = record
        for channel in channels.values():
            self._add_topic(channel, schemas, counts.get(channel.id, 0))

    def _add_topic(self, channel: Channel, schemas: dict[int, Schema], count: int) -> None:
        schema = schemas.get(channel.schema_id)
        before = self.topics.get(channel.topic)
        self.topics[channel.topic] = Topic(
            name=channel.topic,
            type=schema.name if schema else "",
            count=count + (before.count if before else 0),
        )

    def _records(self, file: BinaryIO) -> Iterator[object]:
        """Yield records up to the end or the first damage, which is noted."""
        self.progress = 0.0
        whole = cast(IO[bytes], _Whole(file))
        try:
            for record in StreamReader(whole, validate_crcs=True).records:
                self.progress = file.tell() / self._size
                yield record
        except EndOfFile:
            self.damage = "the file is cut off"
        except _DAMAGE as error:
            self.damage = f"the file is damaged after {self.progress:.0%}: {error}"
        self.progress = 1.0


class _Whole:
    """A file of which a read returns all that is asked for or fails; mcap takes short reads for data."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file

    def read(self, size: int) -> bytes:
        data = self._file.read(size)
        if len(data) < size:
            raise EndOfFile
        return data


def _is_ros(schema: Schema) -> bool:
    return schema.encoding in ("ros2msg", "ros2idl")
