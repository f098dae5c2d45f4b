# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What is in a trace before its messages are read: topics, types, metadata."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import BinaryIO

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel, Footer, Metadata, MetadataIndex, Schema, Statistics

from roller_sim_ros.traces.errors import reading_error
from roller_sim_ros.traces.frames import MAGIC, Damage, FrameReader, open_trace
from roller_sim_ros.traces.records import UNREADABLE, RawMessage, Record, TraceRecords

_FOOTER_SIZE = 9 + 20 + len(MAGIC)

Progress = Callable[[int, int], None]
"""Called with bytes done and bytes in all."""


@dataclass
class TopicInfo:
    """A topic of a trace.

    Attributes
    ----------
    name, type_name : str
        Absolute name, and type as in ``package/msg/Name`` (empty when there is no schema).
    schema_text, schema_encoding : str
        Definition of the type, ``ros2msg`` or another.
    encoding : str
        Of the messages, ``cdr`` or another.
    offered_qos_profiles : str
        As rosbag2 writes it; empty when unknown.
    messages : int
        How many there are.
    """

    name: str
    type_name: str
    schema_text: str
    schema_encoding: str
    encoding: str
    offered_qos_profiles: str
    messages: int = 0


class ChannelTable:
    """Collects schemas and channels as they come, by their numbers in one file."""

    def __init__(self) -> None:
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[int, Channel] = {}

    def take(self, record: object) -> bool:
        """Note a schema or channel; return whether the record was one."""
        if isinstance(record, Schema):
            self.schemas[record.id] = record
        elif isinstance(record, Channel):
            self.channels[record.id] = record
        else:
            return False
        return True

    def type_name(self, channel: Channel) -> str:
        """Return the type of a channel, empty when its schema is not there."""
        schema = self.schemas.get(channel.schema_id)
        return schema.name if schema else ""

    def topics(self, counts: dict[int, int]) -> dict[str, TopicInfo]:
        """Return the topics, with messages as counted by channel number."""
        found: dict[str, TopicInfo] = {}
        for channel in self.channels.values():
            schema = self.schemas.get(channel.schema_id)
            info = found.setdefault(
                channel.topic,
                TopicInfo(
                    name=channel.topic,
                    type_name=schema.name if schema else "",
                    schema_text=schema.data.decode("utf-8", "replace") if schema else "",
                    schema_encoding=schema.encoding if schema else "",
                    encoding=channel.message_encoding,
                    offered_qos_profiles=channel.metadata.get("offered_qos_profiles", ""),
                ),
            )
            info.messages += counts.get(channel.id, 0)
        return found


@dataclass
class Contents:
    """What one file holds.

    Attributes
    ----------
    table : ChannelTable
        Schemas and channels, wherever in the file they stand.
    topics : dict
        `TopicInfo` by name.
    metadata : dict
        Metadata records by name; the last of a name counts.
    start_ns, end_ns : int
        First and last log time, ns since the epoch; 0 without messages.
    damages : list of Damage
        What cannot be used, if the file had to be read for its contents.
    """

    table: ChannelTable = field(default_factory=ChannelTable)
    topics: dict[str, TopicInfo] = field(default_factory=dict)
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    start_ns: int = 0
    end_ns: int = 0
    damages: list[Damage] = field(default_factory=list)


def told(records: TraceRecords, progress: Progress | None) -> Iterator[Record]:
    """Iterate over records and tell the progress as it changes."""
    done = -1
    for record in records:
        if progress and records.position != done:
            done = records.position
            progress(done, records.size)
        yield record


def read_contents(path: Path, progress: Progress | None = None) -> Contents:
    """Return the contents of a file: from its summary, or by reading all of it when it has none.

    Raises
    ------
    TraceError
        As `roller_sim_ros.traces.frames.open_trace`.
    """
    with open_trace(path) as stream:
        try:
            contents = _from_summary(stream)
        except OSError as error:
            raise reading_error(path, error) from error
    return contents or _from_all(path, progress)


def _from_summary(stream: BinaryIO) -> Contents | None:
    """Return the contents by the summary, None if the file has none that tells all."""
    contents = Contents()
    table = contents.table
    statistics: Statistics | None = None
    indexes: list[MetadataIndex] = []
    try:
        size = stream.seek(0, 2)
        if size < len(MAGIC) + _FOOTER_SIZE:
            return None
        footer_at = stream.seek(size - _FOOTER_SIZE)
        (footer_frame,) = FrameReader(stream, size)
        if footer_frame.opcode != Opcode.FOOTER:
            return None
        footer = Footer.read(ReadDataStream(BytesIO(footer_frame.content)))
        if not 0 < footer.summary_start < footer_at:
            return None
        stream.seek(footer.summary_start)
        for frame in FrameReader(stream, size):
            content = ReadDataStream(BytesIO(frame.content))
            if frame.opcode == Opcode.SCHEMA:
                table.take(Schema.read(content))
            elif frame.opcode == Opcode.CHANNEL:
                table.take(Channel.read(content))
            elif frame.opcode == Opcode.STATISTICS:
                statistics = Statistics.read(content)
            elif frame.opcode == Opcode.METADATA_INDEX:
                indexes.append(MetadataIndex.read(content))
        if statistics is None or not _complete(statistics, table, indexes):
            return None
        for index in indexes:
            if index.offset > size:
                return None
            stream.seek(index.offset + 9)
            metadata = Metadata.read(ReadDataStream(stream))
            contents.metadata[metadata.name] = metadata.metadata
    except UNREADABLE:
        return None
    contents.topics = table.topics(statistics.channel_message_counts)
    contents.start_ns = statistics.message_start_time
    contents.end_ns = statistics.message_end_time
    return contents


def _complete(statistics: Statistics, table: ChannelTable, indexes: list[MetadataIndex]) -> bool:
    """Tell whether a summary repeats everything that it counts."""
    return (
        statistics.channel_count == len(table.channels)
        and statistics.schema_count == len(table.schemas)
        and statistics.metadata_count == len(indexes)
    )


def _from_all(path: Path, progress: Progress | None) -> Contents:
    contents = Contents()
    table = contents.table
    counts: dict[int, int] = {}
    with TraceRecords(path) as records:
        for record in told(records, progress):
            if isinstance(record, RawMessage):
                time_ns = record.log_time_ns
                contents.start_ns = min(contents.start_ns, time_ns) if counts else time_ns
                contents.end_ns = max(contents.end_ns, time_ns)
                counts[record.channel_id] = counts.get(record.channel_id, 0) + 1
            elif isinstance(record, Metadata):
                contents.metadata[record.name] = record.metadata
            else:
                table.take(record)
        contents.damages = records.damages
    contents.topics = table.topics(counts)
    return contents
