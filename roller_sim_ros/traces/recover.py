# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Makes a whole trace of one that was cut off or damaged, and accounts for what was lost.

Lost is a message of which the file no longer holds all bytes, which is in a chunk that fails its checksum,
or whose topic is named nowhere in what is left. All other messages, and all metadata, are kept. It is a
failure only when not one message is left.

What a recorder had not written yet when it was killed was never in the file; where the messages count
themselves (`sequence`), such gaps are told as well.
"""

from __future__ import annotations

import shutil
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

from mcap.records import Attachment, Header, Metadata
from mcap.writer import Writer
from rosbags.serde import SerdeError

from roller_sim_ros.traces.contents import ChannelTable, Progress, told
from roller_sim_ros.traces.errors import Problem, TraceError, writing_error
from roller_sim_ros.traces.frames import Damage
from roller_sim_ros.traces.metadata import RUN
from roller_sim_ros.traces.records import RawMessage, Record, TraceRecords
from roller_sim_ros.traces.writer import PROFILE
from roller_sim_ros.wire.types import decode

_COUNTING_SAMPLES = ("roller_sim_ros/msg/DrumAcceleration", "roller_sim_ros/msg/DrumSoilState")


@dataclass
class TopicAccount:
    """What became of a topic.

    Attributes
    ----------
    type_name : str
        As in ``package/msg/Name``.
    kept : int
        Messages that are in the recovered file.
    first_ns, last_ns : int
        Log times of the first and last of them.
    missing_messages : int
        Messages that are missing between those kept, by the counter of this package's recorder.
    sample_gaps : list of (int, int)
        First missing sample and the one after the last, of blocks of samples.
    odd_messages : int
        Blocks of samples that are not what their type says; they are kept as they are.
    """

    type_name: str
    kept: int = 0
    first_ns: int = 0
    last_ns: int = 0
    missing_messages: int = 0
    sample_gaps: list[tuple[int, int]] = field(default_factory=list)
    odd_messages: int = 0
    _sequence: int | None = None
    _next_sample: int | None = None

    @property
    def counts_samples(self) -> bool:
        """Whether its messages are blocks of samples that have an index."""
        return self.type_name in _COUNTING_SAMPLES

    def add(self, message: RawMessage, *, counted: bool) -> None:
        """Note a message that is kept; `counted`: by a recorder of this package."""
        time_ns = message.log_time_ns
        self.first_ns = min(self.first_ns, time_ns) if self.kept else time_ns
        self.last_ns = max(self.last_ns, time_ns)
        self.kept += 1
        if counted:
            if self._sequence is not None:
                self.missing_messages += max(0, message.sequence - self._sequence - 1)
            self._sequence = message.sequence
        if self.counts_samples:
            self._add_samples(message.data)

    def _add_samples(self, data: bytes) -> None:
        try:
            block = decode(data, self.type_name)
        except SerdeError:
            self.odd_messages += 1
            return
        if self._next_sample is not None and block.sequence > self._next_sample:
            self.sample_gaps.append((self._next_sample, block.sequence))
        self._next_sample = block.sequence + len(block.vertical)


@dataclass
class Account:
    """What was found in a file, and what of it is in the recovered one.

    Attributes
    ----------
    source : pathlib.Path
        The file.
    target : pathlib.Path or None
        The recovered file; None when the source is whole and no copy was asked for.
    size : int
        Bytes of the source.
    damages : list of Damage
        What cannot be used.
    salvaged : int
        Messages saved out of a chunk that the end of the file cuts off.
    orphans : int
        Messages that are lost because their topic is named nowhere.
    topics : dict
        `TopicAccount` by name.
    metadata : dict
        Metadata records by name.
    """

    source: Path
    target: Path | None = None
    size: int = 0
    damages: list[Damage] = field(default_factory=list)
    salvaged: int = 0
    orphans: int = 0
    topics: dict[str, TopicAccount] = field(default_factory=dict)
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)

    @property
    def whole(self) -> bool:
        """Whether the source needs no recovery."""
        return not self.damages and not self.orphans

    @property
    def kept(self) -> int:
        """Messages kept."""
        return sum(topic.kept for topic in self.topics.values())

    @property
    def unused_bytes(self) -> int:
        """Bytes of the source that are of no use."""
        return sum(damage.length for damage in self.damages)

    @property
    def indexed_losses(self) -> int:
        """Messages that indexes name in damaged chunks."""
        return sum(damage.messages for damage in self.damages)


def recovered_path(source: Path) -> Path:
    """Return where the recovered file goes when no other place is named."""
    return source.with_name(f"{source.stem}.recovered.mcap")


def recover(
    source: Path,
    target: Path | None = None,
    *,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> Account:
    """Write a whole file of what can be read of another; the source stays as it is.

    Parameters
    ----------
    source : pathlib.Path
        An MCAP file in any state.
    target : pathlib.Path, optional
        The file to write; it appears when it is complete. None: `recovered_path`, or nothing at all if the
        source is whole.
    overwrite : bool
        Replace a target that is there.
    progress : callable, optional
        Called with bytes done and bytes in all; the source is read twice.

    Raises
    ------
    TraceError
        If the source cannot be read or holds no message, or the target cannot be written.
    """
    account = Account(source)
    table = _survey(account, progress)
    if account.whole and target is None:
        _transfer(account, table, None, progress)
        return account
    target = target or recovered_path(source)
    if target.exists() and (not overwrite or target.samefile(source)):
        raise TraceError(
            target,
            Problem.EXISTS,
            "there already is such a file and it is not overwritten",
            "name another with -o",
        )
    account.target = target
    partial = target.with_name(f"{target.name}.partial")
    try:
        if account.whole:
            _transfer(account, table, None, progress)
            shutil.copyfile(source, partial)
        else:
            with partial.open("wb") as stream:
                _transfer(account, table, stream, progress)
        partial.replace(target)
    except OSError as error:
        raise writing_error(target, error) from error
    finally:
        with suppress(OSError):
            partial.unlink()
    return account


def _survey(account: Account, progress: Progress | None) -> ChannelTable:
    """Read the source once for its channels, wherever they stand, its damages and its metadata."""
    table = ChannelTable()
    counts: Counter[int] = Counter()
    with TraceRecords(account.source) as records:
        account.size = records.size
        for record in told(records, progress):
            if isinstance(record, RawMessage):
                counts[record.channel_id] += 1
            elif isinstance(record, Metadata):
                account.metadata[record.name] = record.metadata
            else:
                table.take(record)
        account.damages, account.salvaged = records.damages, records.salvaged
    account.orphans = sum(counts[number] for number in counts.keys() - table.channels.keys())
    account.topics = {
        channel.topic: TopicAccount(table.type_name(channel)) for channel in table.channels.values()
    }
    return table


def _transfer(
    account: Account, table: ChannelTable, stream: BinaryIO | None, progress: Progress | None
) -> None:
    """Read the source again, note what is kept and write it to the stream."""
    copy = _Copy(stream, table) if stream else None
    counted = RUN in account.metadata
    with TraceRecords(account.source) as records:
        for record in told(records, progress):
            if isinstance(record, RawMessage):
                channel = table.channels.get(record.channel_id)
                if channel is None:
                    continue
                account.topics[channel.topic].add(record, counted=counted)
            if copy:
                copy.write(record)
    if not account.kept:
        raise TraceError(
            account.source,
            Problem.DAMAGED,
            f"its {account.size} bytes hold not one message that can be recovered",
            "nothing was written",
        )
    if copy:
        copy.finish()


class _Copy:
    """The recovered file, begun with all schemas and channels."""

    def __init__(self, stream: BinaryIO, table: ChannelTable) -> None:
        self._writer = Writer(stream)
        self._table = table
        self._channels: dict[int, int] = {}
        self._begun = False

    def write(self, record: Record) -> None:
        writer = self._writer
        if not self._begun:
            # The header stands first, unless it is what was damaged.
            writer.start(profile=record.profile if isinstance(record, Header) else PROFILE)
            self._register()
            self._begun = True
        if isinstance(record, RawMessage):
            writer.add_message(
                self._channels[record.channel_id],
                record.log_time_ns,
                record.data,
                record.publish_time_ns,
                record.sequence,
            )
        elif isinstance(record, Metadata):
            writer.add_metadata(record.name, record.metadata)
        elif isinstance(record, Attachment):
            writer.add_attachment(
                record.create_time, record.log_time, record.name, record.media_type, record.data
            )

    def finish(self) -> None:
        self._writer.finish()  # type: ignore[no-untyped-call]

    def _register(self) -> None:
        schemas = {
            number: self._writer.register_schema(schema.name, schema.encoding, schema.data)
            for number, schema in self._table.schemas.items()
        }
        for number, channel in self._table.channels.items():
            self._channels[number] = self._writer.register_channel(
                channel.topic,
                channel.message_encoding,
                schemas.get(channel.schema_id, 0),
                channel.metadata,
            )
