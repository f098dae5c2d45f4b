# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Bags that a third party's writer made of a session."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration, Exciter, Soil
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import typestore

START_NS = 1_700_000_000_000_000_000
BLOCK = 16
REVOLUTIONS = 160
CHANGE = 60
"""Revolution at which the soft ground becomes stiff, and partial uplift double jump."""

Bag = Callable[..., Path]


@pytest.fixture(scope="session")
def run() -> list[Message]:
    """All messages of a short session, the per-sample Imu among them."""
    configuration = Configuration(
        exciter=Exciter(frequency_hz=28.0, amplitude_m=1.6e-3),
        soil=Soil(shear_modulus_pa=35e6, plastic_parameter_m=0.8e-3),
    )
    emulator = Emulator(configuration, start_ns=START_NS)
    messages = []
    for block in range(REVOLUTIONS * SAMPLES_PER_REVOLUTION // BLOCK):
        if block == CHANGE * SAMPLES_PER_REVOLUTION // BLOCK:
            emulator.change({"soil.shear_modulus_pa": 80e6, "soil.plastic_parameter_m": 0.5e-3})
        messages += emulator.advance(BLOCK) + emulator.imu_messages()
    return messages


@pytest.fixture
def bag(tmp_path: Path, run: list[Message]) -> Bag:
    def write(
        messages: Iterable[Message] | None = None,
        name: str = "bag",
        namespace: str = "",
        more: Iterable[Message] = (),
        storage: StoragePlugin = StoragePlugin.MCAP,
        compressed: bool = False,
    ) -> Path:
        """Write a rosbag2 folder; without Imu messages unless they are given."""
        if messages is None:
            messages = [item for item in run if item.topic != topics.IMU.name]
        writer = Writer(tmp_path / name, version=9, storage_plugin=storage)
        if compressed:
            writer.set_compression(CompressionMode.MESSAGE, CompressionFormat.ZSTD)
        with writer:
            connections: dict[str, Any] = {}
            stamped = [(namespace, item) for item in messages] + [("", item) for item in more]
            for number, (space, item) in enumerate(stamped):
                topic = item.topic if item.topic.startswith("/") else f"{space}/{item.topic}"
                if topic not in connections:
                    connections[topic] = writer.add_connection(
                        topic, item.type_name, typestore=typestore()
                    )
                writer.write(connections[topic], START_NS + number * 1000, item.data)
        return tmp_path / name

    return write
