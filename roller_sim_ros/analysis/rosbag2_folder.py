# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A rosbag2 folder in SQLite, or compressed by rosbag2: what `traces` does not read, rosbags does."""

from __future__ import annotations

import sqlite3
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

from rosbags.interfaces import MessageDefinitionFormat
from rosbags.rosbag2 import Reader
from rosbags.rosbag2.errors import ReaderError

from roller_sim_ros.analysis.bag import BagError, Received, Topic
from roller_sim_ros.analysis.decoding import Decoder

_DAMAGE = (ReaderError, sqlite3.Error, ValueError, RuntimeError, EOFError)


class Rosbag2Folder:
    """A folder as ``ros2 bag record`` writes it, read in the order of reception.

    Parameters
    ----------
    path : Path
        The folder.

    Raises
    ------
    BagError
        If it is no rosbag2 folder or its files cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.damage = ""
        self.progress = 0.0
        self.parameters: dict[str, str] = {}
        self.topics: dict[str, Topic] = {}
        self._decoder = Decoder()
        with self._open() as reader:
            for connection in reader.connections:
                before = self.topics.get(connection.topic)
                self.topics[connection.topic] = Topic(
                    name=connection.topic,
                    type=connection.msgtype,
                    count=connection.msgcount + (before.count if before else 0),
                )

    def messages(self, topics: Collection[str]) -> Iterator[Received]:
        """Yield the messages of some topics in the order of their reception."""
        with self._open() as reader:
            connections = [item for item in reader.connections if item.topic in topics]
            for item in connections:
                if item.msgdef.format is MessageDefinitionFormat.NONE:
                    self._decoder.add_installed(item.msgtype)
                else:
                    idl = item.msgdef.format is MessageDefinitionFormat.IDL
                    self._decoder.add(item.msgtype, item.msgdef.data, idl=idl)
            if not connections:
                return
            start, duration = reader.start_time, max(1, reader.duration)
            records = reader.messages(connections)
            while True:
                try:
                    connection, time_ns, data = next(records)
                except StopIteration:
                    break
                except _DAMAGE as error:
                    self.damage = f"{self.path}: it is damaged after {self.progress:.0%}: {error}"
                    break
                self.progress = (time_ns - start) / duration
                message = self._decoder.decode(data, connection.msgtype)
                yield Received(connection.topic, time_ns, message)
            self.progress = 1.0

    @contextmanager
    def _open(self) -> Iterator[Reader]:
        try:
            reader = Reader(self.path)
            reader.open()
        except (*_DAMAGE, KeyError, OSError) as error:
            raise BagError(f"{self.path}: cannot be read: {error}") from None
        try:
            yield reader
        finally:
            reader.close()
