# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A hash of each topic of a run, by which runs are compared that cut their samples into messages differently.

>>> from roller_sim_ros.emulation import Emulator
>>> from roller_sim_ros.parameters import Configuration
>>> found = []
>>> for size in (16, 128):
...     emulator, hashes = Emulator(Configuration(), start_ns=size), StreamHashes(start_ns=size)
...     for _ in range(3 * 128 // size):
...         hashes.feed(emulator.advance(size))
...     found.append(hashes.digests())
>>> found[0] == found[1]
True
"""

from __future__ import annotations

import hashlib
from collections import defaultdict
from collections.abc import Iterable
from functools import cache
from typing import Any, Protocol

import numpy as np

from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.types import decode, typestore

_SECOND_NS = 1_000_000_000
_STAMP = slice(4, 12)
"""Seconds and nanoseconds of a header, right after the four bytes with which CDR begins."""

_SAMPLES = {
    topics.ACCELERATION.type_name: ("vertical", "horizontal", "raw_vertical", "raw_horizontal"),
    topics.TRUTH.type_name: (
        *("vertical", "horizontal", "soil_force", "soil_displacement", "plastic_depth"),
        "contact_state",
    ),
}
"""Fields with a value for each sample, but heights: those are told over a datum of the message's own."""

_AT_A_REVOLUTION_S_BEGIN = ("eccentric_phase", "shear_modulus", "plastic_parameter")
_AT_ITS_END = (
    *("cmv", "rmv", "air_fraction", "force_ratio_max"),
    *("period", "blows_per_period", "mode"),
)
RUN_TOPICS = tuple(
    topic
    for topic in topics.TOPICS
    if topic.direction is topics.Direction.PUBLISHED
    and topic not in (topics.DIAGNOSTICS, topics.CLOCK)
)
"""What an emulator says, and not the node that drives it."""
_HASHED = {topic.type_name for topic in RUN_TOPICS} - {
    topics.INPUTS.type_name,
    topics.IMU.type_name,
}


class Streamed(Protocol):
    """A message as the emulator makes it or as a trace holds it."""

    @property
    def topic(self) -> str:
        """Name of its topic."""
        ...

    @property
    def type_name(self) -> str:
        """As in ``package/msg/Name``."""
        ...

    @property
    def data(self) -> bytes:
        """CDR."""
        ...


class StreamHashes:
    """Takes messages in their order; `digests` says what came.

    Of ``drum/acceleration`` and ``truth`` it takes sample by sample what belongs to a sample, and of the latter, where
    a revolution begins or ends, what belongs to that. ``exciter/state`` comes ten times a second with whatever
    block is the next: of it, it takes what changes. Of everything else it takes every byte, stamps from the start of
    the run. What is of the driver and not of the run is left out: ``inputs``, commands, diagnostics, ``/clock``, and
    ``drum/imu``, which only comes while someone listens.

    Two things do depend on the size of the blocks and show: messages that a fault doubles or puts in another order,
    and how much a sensor that delivers late still has to deliver at the end.

    Parameters
    ----------
    start_ns : int
        Stamp of the first sample, ns since the epoch.
    """

    def __init__(self, start_ns: int = 0) -> None:
        self._start_ns = start_ns
        # By topic and within it by field: fields of blocks of any size are then each one stream.
        self._hashes: dict[str, Any] = defaultdict(lambda: defaultdict(hashlib.sha256))
        self._states: dict[str, bytes] = {}

    def feed(self, messages: Iterable[Streamed]) -> None:
        """Take the next messages."""
        for message in messages:
            if message.type_name not in _HASHED:
                continue
            if message.type_name in _SAMPLES:
                self._samples(message)
            elif message.type_name == topics.EXCITER_STATE.type_name:
                state = message.data[_STAMP.stop :]
                if self._states.get(message.topic) != state:
                    self._states[message.topic] = state
                    self._hashes[message.topic][""].update(state)
            else:
                self._hashes[message.topic][""].update(self._bytes(message))

    def digests(self) -> dict[str, str]:
        """Return the SHA-256 of each topic that came, by its name, in hexadecimal digits."""
        return {
            topic: hashlib.sha256(
                b"".join(name.encode() + parts[name].digest() for name in sorted(parts))
            ).hexdigest()
            for topic, parts in sorted(self._hashes.items())
        }

    def _bytes(self, message: Streamed) -> bytes:
        data = message.data
        if not _has_header(message.type_name):
            return data
        seconds, nanoseconds = np.frombuffer(data[_STAMP], "<i4")
        since_ns = int(seconds) * _SECOND_NS + int(np.uint32(nanoseconds)) - self._start_ns
        since = since_ns.to_bytes(8, "little", signed=True)
        return data[: _STAMP.start] + since + data[_STAMP.stop :]

    def _samples(self, message: Streamed) -> None:
        parts = self._hashes[message.topic]
        block = decode(message.data, message.type_name)
        for name in _SAMPLES[message.type_name]:
            parts[name].update(np.ascontiguousarray(getattr(block, name)).tobytes())
        count = len(block.vertical)
        timing = np.empty((count, 4))
        timing[:, 0] = block.sequence + np.arange(count)
        timing[:, 1:] = block.sample_period, block.excitation_frequency, block.phase_increment
        parts["timing"].update(timing.tobytes())
        if message.type_name != topics.TRUTH.type_name:
            return
        if block.sequence % SAMPLES_PER_REVOLUTION == 0:
            stamp = block.header.stamp
            since_ns = stamp.sec * _SECOND_NS + stamp.nanosec - self._start_ns
            parts["begin"].update(since_ns.to_bytes(8, "little", signed=True))
            parts["begin"].update(_numbers(block, _AT_A_REVOLUTION_S_BEGIN))
        if (block.sequence + count) % SAMPLES_PER_REVOLUTION == 0:
            parts["end"].update(_numbers(block, _AT_ITS_END))


def _numbers(block: Any, names: Iterable[str]) -> bytes:
    return np.array([getattr(block, name) for name in names], dtype=np.float64).tobytes()


@cache
def _has_header(type_name: str) -> bool:
    fields = typestore().fielddefs[type_name][1]
    return bool(fields) and fields[0][0] == "header"
