# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Hashes of streams: the same for the same run however it is cut, another for another run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.emulation.snapshot import restore, save
from roller_sim_ros.emulation.streams import StreamHashes
from roller_sim_ros.scenario import parse_scenario, start_of
from roller_sim_ros.wire import topics

TEXT = """
lane: {length_m: 8}
travel: {speed_m_s: 3}
ground:
  preset: paper-soft
  features: [{kind: random_field, coefficient_of_variation: 0.3, correlation_length_m: 1.0}]
sensors: [{name: mems_10g, parameters: {latency_s: 0.0}}, {name: tacho}, {name: odometry}, {name: gnss}]
faults: [{id: noise_burst, from_revolution: 30, to_revolution: 40}, {id: spike, from_m: 3, to_m: 6}]
parameters: {half_space.model: two-pole}
seed: SEED
"""
REVOLUTIONS = 60


def emulator(seed: int = 2, start_ns: int = 0) -> Emulator:
    scenario = parse_scenario(TEXT.replace("SEED", str(seed)), Path("test.yaml"))
    return Emulator(start_ns=start_ns, **start_of(scenario)._asdict())


def digests(roller: Emulator, sizes: list[int], saved_in: int = -1) -> dict[str, str]:
    """Return the hashes of a run whose revolutions are cut into blocks of these sizes, saved and restored in one."""
    hashes = StreamHashes(roller.start_ns)
    for revolution in range(REVOLUTIONS):
        if revolution == 20:
            roller.command(vibrate=True, frequency_hz=33.0, amplitude_m=1.2e-3)
        if revolution == 40:
            roller.release()
        for size in sizes:
            hashes.feed(roller.advance(size))
            if revolution == saved_in:
                roller = restore(save(roller))
    return hashes.digests()


@pytest.mark.parametrize("sizes", [[16] * 8, [1, 127], [100, 28]])
def test_blocks_and_saving_change_no_stream(sizes: list[int]) -> None:
    expected = digests(emulator(), [128])
    assert digests(emulator(start_ns=1_700_000_000_987_654_321), sizes, saved_in=33) == expected
    assert {"tacho", "odom", "fix", "meter", "cmv", "truth", "faults", "applied"} <= set(expected)


def test_another_seed_is_another_stream_where_there_are_random_numbers() -> None:
    one, other = digests(emulator(2), [128]), digests(emulator(3), [128])
    different = {topic for topic in one if one[topic] != other[topic]}
    assert {"drum/acceleration", "truth", "cmv", "fix", "odom"} <= different
    assert "machine" not in different


@pytest.mark.parametrize("topic", ["drum/acceleration", "truth", "meter", "exciter/state"])
def test_one_bit_or_one_message_shows(topic: str) -> None:
    roller = emulator()
    messages = [message for _ in range(20) for message in roller.advance(128)]
    changed, shortened = list(messages), list(messages)
    last = max(index for index, message in enumerate(messages) if message.topic == topic)
    data = bytearray(messages[last].data)
    place = len(data) // 5 if topic in (topics.ACCELERATION.name, topics.TRUTH.name) else 34
    data[place] ^= 1
    changed[last] = messages[last]._replace(data=bytes(data))
    del shortened[last]
    found: list[Any] = []
    for stream in (messages, changed, shortened):
        hashes = StreamHashes()
        hashes.feed(stream)
        found.append(hashes.digests())
    for other in found[1:2] if topic == "exciter/state" else found[1:]:
        assert {name for name in found[0] if found[0][name] != other.get(name)} == {topic}
