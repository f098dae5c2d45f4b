# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Columns of messages against the same messages decoded one by one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.opcode import Opcode
from mcap.writer import Writer

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.offline.recording import record
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.traces.columns import Layout, Messages, read_messages
from roller_sim_ros.traces.frames import FrameReader, open_trace
from roller_sim_ros.traces.metadata import run_metadata
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.wire.types import decode, typestore

REVOLUTIONS = 40
CHUNK_BYTES = 50_000
TOPICS = ("/drum/acceleration", "/truth", "/meter", "/exciter/state", "/site/state")


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recorded run, written once more in many chunks: of a recording they go by the clock."""
    folder = tmp_path_factory.mktemp("columns")
    configuration = Configuration()
    emulator = Emulator(configuration, start_ns=10**18)
    with record(emulator, folder / "run.mcap", run_metadata(configuration, 10**18)) as step:
        for _ in range(REVOLUTIONS * 128 // configuration.pacing.samples_per_message):
            step()
    reader = TraceReader(folder / "run.mcap")
    with (folder / "chunks.mcap").open("wb") as stream:
        writer = Writer(stream, chunk_size=CHUNK_BYTES)
        writer.start(profile="ros2")
        channels = {}
        for info in reader.topics.values():
            text = info.schema_text.encode("utf-8")
            schema = writer.register_schema(info.type_name, info.schema_encoding, text)
            channels[info.name] = writer.register_channel(info.name, info.encoding, schema)
        for item in reader.messages():
            writer.add_message(
                channels[item.topic], item.log_time_ns, item.data, item.publish_time_ns
            )
        writer.finish()
    return folder / "chunks.mcap"


def decoded(path: Path, topic: str) -> list[Any]:
    return [decode(item.data, item.type_name) for item in TraceReader(path).messages({topic})]


def read(path: Path, topic: str, *names: str) -> dict[str, np.ndarray[Any, Any]]:
    """Fields of all messages by the layout of the first."""
    type_name = TraceReader(path).topics[topic].type_name
    layout: Layout | None = None
    found: dict[str, list[Any]] = {name: [] for name in names}
    for chunk in read_messages(path, {topic}):
        messages = chunk[topic]
        layout = layout or Layout(typestore().fielddefs, type_name, messages.bytes_of(0))
        assert layout.alike(messages).all()
        for name in names:
            found[name].append(layout.field(messages, name))
    return {name: np.concatenate(parts) for name, parts in found.items()}


@pytest.mark.parametrize("topic", TOPICS)
def test_every_number_is_that_of_the_decoded_message(trace: Path, topic: str) -> None:
    one_by_one = decoded(trace, topic)
    assert one_by_one
    type_name = TraceReader(trace).topics[topic].type_name
    checked = 0
    for name, _ in typestore().fielddefs[type_name][1]:
        if name == "header" or isinstance(getattr(one_by_one[0], name), str):
            continue
        found = read(trace, topic, name)[name]
        expected = np.array([getattr(item, name) for item in one_by_one])
        np.testing.assert_array_equal(found, expected)
        checked += 1
    assert checked >= 5
    stamps = read(trace, topic, "header.stamp.sec", "header.stamp.nanosec")
    nanoseconds = stamps["header.stamp.nanosec"].tolist()
    assert nanoseconds == [item.header.stamp.nanosec for item in one_by_one]


def test_times_and_order_are_those_of_the_trace(trace: Path) -> None:
    chunks = list(read_messages(trace, {"/meter", "/cmv"}))
    assert len(chunks) > 1
    for topic in ("/meter", "/cmv"):
        times = np.concatenate([chunk[topic].log_time_ns for chunk in chunks if topic in chunk])
        raw = list(TraceReader(trace).messages({topic}))
        assert times.tolist() == [item.log_time_ns for item in raw]
        data = [
            chunk[topic].bytes_of(number)
            for chunk in chunks
            if topic in chunk
            for number in range(len(chunk[topic].starts))
        ]
        assert data == [item.data for item in raw]


def test_a_message_of_another_shape_is_told_apart(trace: Path) -> None:
    (first, *_) = read_messages(trace, {"/exciter/state"})
    messages = first["/exciter/state"]
    layout = Layout(typestore().fielddefs, "roller_sim_ros/msg/ExciterState", messages.bytes_of(0))
    longer = bytearray(messages.bytes_of(0)) + bytes(4)
    other = bytearray(messages.bytes_of(0))
    other[4 + 8] ^= 1  # length of frame_id
    data = np.frombuffer(bytes(longer) + bytes(other), dtype=np.uint8)
    both = Messages(
        data,
        np.array([0, len(longer)]),
        np.array([len(longer), len(other)]),
        np.zeros(2, dtype=np.uint64),
    )
    assert layout.alike(both).tolist() == [False, False]


def test_damage_costs_its_chunk_only(trace: Path, tmp_path: Path) -> None:
    whole = sum(len(chunk["/meter"].starts) for chunk in read_messages(trace, {"/meter"}))
    data = bytearray(trace.read_bytes())
    with open_trace(trace) as stream:
        frames = list(FrameReader(stream, len(data)))
    chunks = [frame for frame in frames if frame.opcode == Opcode.CHUNK]
    assert len(chunks) > 2
    chunk = chunks[1]
    data[chunk.offset + len(chunk.content) // 2] ^= 0xFF
    path = tmp_path / "damaged.mcap"
    path.write_bytes(data)
    left = sum(
        len(chunk["/meter"].starts)
        for chunk in read_messages(path, {"/meter"})
        if "/meter" in chunk
    )
    assert 0 < left < whole
