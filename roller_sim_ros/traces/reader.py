# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Reads traces message by message: MCAP files and rosbag2 folders, whole or not."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path
from typing import NamedTuple

from roller_sim_ros.traces.bag import trace_files
from roller_sim_ros.traces.contents import (
    ChannelTable,
    Contents,
    Progress,
    TopicInfo,
    read_contents,
)
from roller_sim_ros.traces.errors import Problem, TraceError
from roller_sim_ros.traces.frames import Damage
from roller_sim_ros.traces.records import RawMessage, TraceRecords
from roller_sim_ros.traces.writer import ENCODING


class TraceMessage(NamedTuple):
    """A message of a trace.

    Attributes
    ----------
    topic, type_name : str
        Absolute name, and type as in ``package/msg/Name``.
    log_time_ns, publish_time_ns : int
        When it was received and published, ns since the epoch.
    data : bytes
        CDR.
    sequence : int
        The recording's counter of the topic's messages; 0 where the recorder does not count.
    """

    topic: str
    type_name: str
    log_time_ns: int
    publish_time_ns: int
    data: bytes
    sequence: int


class TraceReader:
    """A trace, opened; its topics are known at once, its messages come one by one.

    Parameters
    ----------
    path : pathlib.Path
        An MCAP file or the folder of a rosbag2 bag.
    progress : callable, optional
        Called with bytes done and bytes in all while a file without summary is looked through.

    Attributes
    ----------
    topics : dict
        `TopicInfo` by name; only topics whose messages are CDR, as all of ROS 2 are.
    metadata : dict
        Metadata records by name.
    start_ns, end_ns : int
        First and last log time, ns since the epoch; 0 without messages.
    size : int
        Bytes of all files.

    Raises
    ------
    TraceError
        If there is no such trace, it cannot be read, is empty or something else, or holds no topic at all.

    Examples
    --------
    ::

        reader = TraceReader(Path("trace.mcap"))
        for message in reader.messages({"/cmv"}):
            print(message.log_time_ns, decode(message.data, message.type_name).data)
        print(reader.damage_text())
    """

    def __init__(self, path: Path, progress: Progress | None = None) -> None:
        self.path = path
        self.topics: dict[str, TopicInfo] = {}
        self.metadata: dict[str, dict[str, str]] = {}
        self.start_ns = self.end_ns = 0
        self.size = 0
        self._files = [(file, read_contents(file, progress)) for file in trace_files(path)]
        self._damages: dict[tuple[Path, int], Damage] = {}
        self._position = 0
        for file, contents in self._files:
            self._add(file, contents)
        if not self.topics:
            raise TraceError(
                path, Problem.EMPTY, "it holds no topic of ROS 2", "there is nothing to read in it"
            )

    @property
    def position(self) -> int:
        """Bytes that `messages` has read so far."""
        return self._position

    @property
    def whole(self) -> bool:
        """Whether no damage is known; certain once `messages` is through."""
        return not self._damages

    def messages(self, topics: Collection[str] | None = None) -> Iterator[TraceMessage]:
        """Yield the messages in the order in which they were recorded.

        Damaged parts are left out and noted, see `damage_text`.

        Parameters
        ----------
        topics : collection of str, optional
            Absolute names of those wanted; all when left out.
        """
        wanted = self.topics.keys() if topics is None else self.topics.keys() & set(topics)
        before = 0
        for file, contents in self._files:
            with TraceRecords(file) as records:
                for message in _messages(records, contents.table, wanted):
                    self._position = before + records.position
                    yield message
                self._note(file, records.damages)
                before += records.size
        self._position = self.size

    def damage_text(self) -> str | None:
        """Return in one line what of the trace cannot be used, None when all can."""
        if not self._damages:
            return None
        (file, _), first = next(iter(self._damages.items()))
        unused = sum(damage.length for damage in self._damages.values())
        more = f", and {len(self._damages) - 1} more" if len(self._damages) > 1 else ""
        return (
            f"{file}: {first.reason} at byte {first.offset}{more}; {unused} of {self.size} bytes are not "
            "used; `roller-sim recover` makes a whole file of the rest"
        )

    def _add(self, file: Path, contents: Contents) -> None:
        for name, info in contents.topics.items():
            if info.encoding != ENCODING:
                continue
            if name in self.topics:
                self.topics[name].messages += info.messages
            else:
                self.topics[name] = info
        self.metadata.update(contents.metadata)
        if contents.end_ns:
            self.start_ns = min(self.start_ns or contents.start_ns, contents.start_ns)
            self.end_ns = max(self.end_ns, contents.end_ns)
        self._note(file, contents.damages)
        self.size += file.stat().st_size

    def _note(self, file: Path, damages: list[Damage]) -> None:
        for damage in damages:
            self._damages[file, damage.offset] = damage


def _messages(
    records: TraceRecords, table: ChannelTable, wanted: Collection[str]
) -> Iterator[TraceMessage]:
    names = {
        number: (channel.topic, table.type_name(channel))
        for number, channel in table.channels.items()
        if channel.message_encoding == ENCODING and channel.topic in wanted
    }
    for record in records:
        if isinstance(record, RawMessage) and record.channel_id in names:
            yield TraceMessage(
                *names[record.channel_id],
                record.log_time_ns,
                record.publish_time_ns,
                record.data,
                record.sequence,
            )
