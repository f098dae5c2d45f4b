# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A short recording with every topic of the package, made of its own messages."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from mcap.writer import CompressionType, Writer

from roller_sim_ros.meters import MeterValue, Mode, Status, TruthValue
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sensors import Fix, IdealAccelerometer, Pulse, Travelled
from roller_sim_ros.sensors.geodesy import Geodetic
from roller_sim_ros.session import Applied, Block, ExciterCommand, ExciterStatus, Master
from roller_sim_ros.site import Position
from roller_sim_ros.traces.metadata import run_metadata
from roller_sim_ros.traces.registration import register_all
from roller_sim_ros.traces.writer import TraceWriter
from roller_sim_ros.wire import instruments, messages, topics
from roller_sim_ros.wire.imu import imu
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import encode, message_class, schema

START_NS = 1_700_000_000_000_000_000
SAMPLES = 16
PERIOD_S = 1 / 3584.0


def make_block(index: int) -> Block:
    rng = np.random.default_rng(index)
    numbers = rng.normal(size=(6, SAMPLES))
    first = index * SAMPLES
    return Block(
        first_sample=first,
        time_s=first * PERIOD_S,
        sample_period_s=PERIOD_S,
        excitation_hz=28.0,
        eccentric_phase_rad=(first % 128) * 2 * math.pi / 128,
        phase_increment_rad=2 * math.pi / 128,
        acceleration_vertical=numbers[0],
        acceleration_horizontal=numbers[1],
        soil_force=abs(numbers[2]),
        drum_height=numbers[3],
        soil_displacement=numbers[4],
        plastic_depth=abs(numbers[5]),
        height_datum=np.zeros(SAMPLES),
        contact_state=rng.integers(0, 3, SAMPLES).astype(np.uint8),
        shear_modulus_pa=35e6,
        plastic_parameter_m=1e-3,
    )


def _travel_command() -> Message:
    """``cmd_vel``, which only others publish."""
    vector = message_class("geometry_msgs/msg/Vector3")
    type_name = topics.CMD_VEL.type_name
    twist = message_class(type_name)(vector(1.0, 0.0, 0.0), vector(0.0, 0.0, 0.0))
    return Message(topics.CMD_VEL.name, type_name, encode(twist, type_name), START_NS)


def make_messages(blocks: int) -> list[Message]:
    """All topics: facts at the start, blocks, a meter value now and then, one of each rare kind."""
    configuration = Configuration()
    status = ExciterStatus(True, 28.0, 1.6e-3, 28.0, 1.6e-3, 1.5e5, 0)
    found = [
        messages.machine_facts(configuration, START_NS),
        messages.soil_facts(configuration, START_NS),
        messages.parameter_event("/roller", {"soil.shear_modulus_pa": 35e6}, START_NS),
        messages.exciter_command(ExciterCommand(True, 28.0, 1.6e-3), START_NS),
        messages.run_input(0, "release", "{}", b"", START_NS),
        _travel_command(),
        messages.exciter_state(status, START_NS),
        messages.applied_change(Applied(0, "exciter.frequency_hz", 28.0), START_NS),
        messages.diagnostic_array([messages.Diagnostic("pacing", values={"x": 1.5})], START_NS),
        instruments.fault_states([], [], 0, START_NS),
        instruments.tacho_pulse(Pulse(1, 0.01, 0.0, 1.0 / 28.0), START_NS),
        instruments.odometry(Travelled(0.0, 0, 1.0, 0.01, 1.0, 0.02), START_NS),
        instruments.fix(Fix(0.0, 0, Geodetic(59.0, 18.0, 20.0), (1e-4, 1e-4, 4e-4)), START_NS),
    ]
    sensor = IdealAccelerometer()
    for index in range(blocks):
        block = make_block(index)
        (reading,) = sensor.read(block)
        found.append(messages.drum_acceleration(reading, START_NS))
        found.append(messages.drum_soil_state(block, TruthValue(), START_NS))
        if index == 0:
            found += imu(reading, START_NS)
        if index % 8 == 7:
            last = (index + 1) * SAMPLES - 1
            stamp = messages.sample_stamp(block, SAMPLES - 1, START_NS)
            value = MeterValue(last, 16, 50.0, 1.0, 28.0, 55.0, 0.1, 1, Mode.UNKNOWN, Status.NONE)
            found += [messages.compaction_meter(value, stamp), messages.cmv(value, stamp)]
            found.append(
                messages.site_state(
                    block, Position(), TruthValue(), (Master.NONE, Master.NONE), START_NS
                )
            )
            found += messages.further_meters(value, stamp)
    return found


@dataclass(frozen=True)
class Written:
    """A message as it went into a trace; compares with what `TraceReader` yields."""

    topic: str
    type_name: str
    log_time_ns: int
    publish_time_ns: int
    data: bytes = field(repr=False)


@dataclass(frozen=True)
class Recording:
    """A trace and what went into it."""

    path: Path
    written: list[Written] = field(repr=False)


def write(
    path: Path,
    blocks: int = 24,
    *,
    flush_period_s: float = 3600.0,
    namespace: str = "/",
    overwrite: bool = False,
) -> Recording:
    configuration = Configuration()
    written = []
    with TraceWriter(
        path,
        run_metadata(configuration, START_NS, seed=7),
        flush_period_s=flush_period_s,
        overwrite=overwrite,
    ) as trace:
        names = register_all(trace, configuration.pacing, namespace)
        for index, message in enumerate(make_messages(blocks)):
            item = Written(
                names[message.topic],
                message.type_name,
                message.stamp_ns + 1000 + index,
                message.stamp_ns,
                message.data,
            )
            trace.put(item.topic, item.data, item.log_time_ns, item.publish_time_ns)
            written.append(item)
    return Recording(path, written)


@pytest.fixture
def record(tmp_path: Path) -> Callable[..., Recording]:
    """Write a trace in the test's own folder."""
    return lambda name="trace.mcap", **options: write(tmp_path / name, **options)


@pytest.fixture(scope="session")
def chunked(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    """A trace in which every message is a chunk; not to be changed."""
    return write(tmp_path_factory.mktemp("chunked") / "trace.mcap", 12, flush_period_s=0.0)


@pytest.fixture(scope="session")
def messages_written() -> list[Message]:
    return make_messages(12)


def write_foreign(path: Path, compression: CompressionType, *, chunks: bool) -> Recording:
    """A trace as another program writes it: own chunk size and compression, or no chunks at all."""
    written = []
    with path.open("wb") as stream:
        writer = Writer(stream, chunk_size=3000, compression=compression, use_chunking=chunks)
        writer.start(profile="ros2", library="another")
        writer.add_metadata("site", {"lane": "7"})
        channels: dict[str, int] = {}
        for index, message in enumerate(make_messages(12)):
            topic = f"/{message.topic}".replace("//", "/")
            if topic not in channels:
                known = schema(message.type_name)
                number = writer.register_schema(known.name, "ros2msg", known.text.encode())
                channels[topic] = writer.register_channel(
                    topic, "cdr", number, {"offered_qos_profiles": ""}
                )
            time_ns = message.stamp_ns
            writer.add_message(channels[topic], time_ns + index, message.data, time_ns)
            written.append(
                Written(topic, message.type_name, time_ns + index, time_ns, message.data)
            )
        writer.finish()
    return Recording(path, written)


@pytest.fixture(scope="session")
def foreign(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Recording]:
    """Traces of another program by kind; not to be changed."""
    folder = tmp_path_factory.mktemp("foreign")
    return {
        name: write_foreign(folder / f"{name}.mcap", compression, chunks=chunks)
        for name, compression, chunks in (
            ("zstd", CompressionType.ZSTD, True),
            ("lz4", CompressionType.LZ4, True),
            ("uncompressed", CompressionType.NONE, True),
            ("unchunked", CompressionType.NONE, False),
        )
    }
