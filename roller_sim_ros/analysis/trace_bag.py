# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""An MCAP trace as a bag: one file or a rosbag2 folder of them, whole or not."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path

from roller_sim_ros.analysis.bag import Received, Topic
from roller_sim_ros.analysis.decoding import Decoder
from roller_sim_ros.traces.metadata import PARAMETERS
from roller_sim_ros.traces.reader import TraceReader


class TraceBag:
    """An MCAP trace, read in the order of the file, in bounded memory and past what is damaged.

    Parameters
    ----------
    path : Path
        MCAP file or folder.

    Raises
    ------
    TraceError
        If there is no such trace or it holds nothing of ROS 2.
    """

    def __init__(self, path: Path) -> None:
        self._reader = TraceReader(path)
        self._decoder = Decoder()
        self.topics = {
            info.name: Topic(info.name, info.type_name, info.messages)
            for info in self._reader.topics.values()
        }
        self.parameters = self._reader.metadata.get(PARAMETERS, {})

    @property
    def damage(self) -> str:
        """What of the bag cannot be used; certain once all messages were read."""
        return self._reader.damage_text() or ""

    @property
    def progress(self) -> float:
        """Share of the bytes that were read."""
        return self._reader.position / max(1, self._reader.size)

    def messages(self, topics: Collection[str]) -> Iterator[Received]:
        """Yield the messages of some topics in the order of the file."""
        for name in topics:
            info = self._reader.topics[name]
            idl = info.schema_encoding != "ros2msg"
            self._decoder.add(info.type_name, info.schema_text, idl=idl)
        for raw in self._reader.messages(topics):
            message = self._decoder.decode(raw.data, raw.type_name)
            yield Received(raw.topic, raw.log_time_ns, message)
