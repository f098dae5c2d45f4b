# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Any bag: an MCAP file or a rosbag2 folder, read front to back with the types that it brings along.

No message package needs to be installed: definitions come from the schemas in the bag.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.traces.bag import METADATA
from roller_sim_ros.traces.errors import Problem, TraceError


class BagError(RollerSimError):
    """A bag cannot be read or does not hold what is asked of it."""


@dataclass(frozen=True)
class Topic:
    """A topic of a bag.

    Attributes
    ----------
    name : str
        As in ``/drum/acceleration``.
    type : str
        As in ``std_msgs/msg/Float64``.
    count : int
        Messages in the bag.
    """

    name: str
    type: str
    count: int


@dataclass(frozen=True)
class Received:
    """One message of a bag.

    Attributes
    ----------
    topic : str
        Name of its topic.
    time_ns : int
        When it was received, ns since 1970.
    message : object
        The message; fields as attributes, number arrays as numpy arrays.
    """

    topic: str
    time_ns: int
    message: Any


class Bag(Protocol):
    """A bag that is open for reading, once or several times."""

    @property
    def topics(self) -> Mapping[str, Topic]:
        """Topics by name."""
        ...

    @property
    def parameters(self) -> Mapping[str, str]:
        """Parameters of the run that were recorded with it, by their dotted names; often none."""
        ...

    @property
    def damage(self) -> str:
        """What of the bag cannot be used, empty as long as nothing is known of that."""
        ...

    @property
    def progress(self) -> float:
        """Share of the bag that the running `messages` has gone through, 0 to 1."""
        ...

    def messages(self, topics: Collection[str]) -> Iterator[Received]:
        """Yield the messages of some topics; of a damaged bag those that can be read."""
        ...


def open_bag(path: Path) -> Bag:
    """Open an MCAP file or a rosbag2 folder, MCAP or what else rosbags reads (SQLite, compressed).

    Parameters
    ----------
    path : Path
        The file or folder.

    Raises
    ------
    RollerSimError
        If there is nothing that can be read as a bag.
    """
    from roller_sim_ros.analysis.rosbag2_folder import Rosbag2Folder
    from roller_sim_ros.analysis.trace_bag import TraceBag

    try:
        return TraceBag(path)
    except TraceError as error:
        if error.problem is Problem.FOREIGN and (path / METADATA).is_file():
            return Rosbag2Folder(path)
        raise
