# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The emulator: which messages come when, and what they say."""

from __future__ import annotations

import json
import math
import threading
import time
from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.meters import CompactionMeter, Mode, TruthMeter
from roller_sim_ros.meters.drum import Drum
from roller_sim_ros.parameters import Configuration, ParameterError, Value
from roller_sim_ros.session import Block, CommandRefused, Refusal
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import decode

START_NS = 1_700_000_000_123_456_789
BLOCKS = ["drum/acceleration", "truth"]
METERS = ["meter", "cmv", "meters/ccv", "meters/omega", "meters/e_vib", "meters/k_s"]


def emulator(run_up: bool = False, **values: Value) -> Emulator:
    """Return an emulator with some parameters changed, `__` for the dot of their names."""
    named = {name.replace("__", "."): value for name, value in values.items()}
    return Emulator(Configuration().changed(named), start_ns=START_NS, run_up=run_up)


def topics(messages: Iterable[Message]) -> list[str]:
    return [message.topic for message in messages]


def of(messages: Iterable[Message], topic: str) -> list[Any]:
    return [decode(item.data, item.type_name) for item in messages if item.topic == topic]


def after(roller: Emulator, samples: int, size: int = 16) -> list[Message]:
    return [message for _ in range(samples // size) for message in roller.advance(size)]


def stamp_ns(message: Any) -> int:
    return int(message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec)


def test_messages_come_in_their_order() -> None:
    roller = emulator()
    assert topics(roller.advance(64)) == [
        *("inputs", *BLOCKS, "faults", "exciter/state", "machine", "soil")
    ]
    assert topics(roller.advance(64)) == [*BLOCKS, *METERS, "site/state"]
    roller.command(vibrate=True, frequency_hz=28.0, amplitude_m=1.5e-3)
    roller.change({"soil.shear_modulus_pa": 80e6})
    assert topics(roller.advance(128)) == [
        *("inputs", "inputs", *BLOCKS),
        *(*METERS, "site/state", "applied", "applied", "exciter/state", "machine", "soil"),
    ]


def test_samples_are_the_session_s_in_single_precision() -> None:
    roller = emulator()
    (acceleration,) = of(roller.advance(16), "drum/acceleration")
    block = roller.block
    assert block is not None
    assert (
        acceleration.vertical.tobytes() == block.acceleration_vertical.astype(np.float32).tobytes()
    )
    assert acceleration.sequence == 0
    assert stamp_ns(acceleration) == START_NS
    (acceleration,) = of(roller.advance(16), "drum/acceleration")
    assert acceleration.sequence == 16
    assert stamp_ns(acceleration) == START_NS + round(16e9 / (28.0 * 128))


def test_meter_and_truth_are_those_of_the_published_samples() -> None:
    roller = emulator(soil__shear_modulus_pa=35e6, soil__plastic_parameter_m=0.8e-3)
    machine, exciter = roller.session.configuration.machine, roller.session.configuration.exciter
    meter, truth = (
        CompactionMeter(drum=Drum.of(machine, exciter)),
        TruthMeter(16, machine.static_load_n),
    )
    for _ in range(120 * 2):
        messages = roller.advance(64)
        block = roller.block
        assert block is not None
        (acceleration,) = of(messages, "drum/acceleration")
        values = meter.feed(
            acceleration.sequence,
            acceleration.vertical,
            acceleration.sample_period,
            acceleration.excitation_frequency,
            acceleration.eccentric_phase,
            acceleration.phase_increment,
            exciter.amplitude_m,
        )
        published = of(messages, "meter")
        assert len(published) == len(values)
        for value, message, (cmv,) in zip(values, published, [of(messages, "cmv")], strict=False):
            assert roller.meter_value == value or math.isnan(value.cmv)
            assert message.last_sample == value.last_sample
            assert cmv.data == message.cmv or math.isnan(cmv.data)
            for name, number in value.further.items():
                (alone,) = of(messages, f"meters/{name}")
                assert alone.data == number or (math.isnan(alone.data) and math.isnan(number))
            end_s = block.time_s + (len(block) - 1) * block.sample_period_s
            assert stamp_ns(message) == START_NS + round(end_s * 1e9)
        expected = truth.feed(block)
        (state,) = of(messages, "truth")
        assert state.force_ratio_max == expected.force_ratio_max or math.isnan(
            state.force_ratio_max
        )
        assert roller.truth_value.last_sample == expected.last_sample
    assert roller.meter_value is not None
    assert roller.meter_value.mode is Mode.PARTIAL_UPLIFT
    assert all(number > 0.0 for number in roller.meter_value.further.values())
    assert roller.truth_value.mode is Mode.PARTIAL_UPLIFT
    assert roller.truth_value.cmv == pytest.approx(roller.meter_value.cmv, rel=1e-5)


@pytest.mark.parametrize("size", [1, 16, 128])
def test_exciter_state_comes_ten_times_a_simulated_second(size: int) -> None:
    roller = emulator()
    messages = after(roller, 28 * 128 * 2, size)
    times = [(stamp_ns(state) - START_NS) * 1e-9 for state in of(messages, "exciter/state")]
    assert len(times) == 20
    block_s = size / (28.0 * 128)
    for tenth, time_s in enumerate(times):
        assert 0.1 * tenth - 1e-9 <= time_s < 0.1 * tenth + block_s + 1e-9


def test_exciter_state_comes_with_every_change_of_a_run_up() -> None:
    roller = emulator(run_up=True)
    states = of(after(roller, 20 * 128), "exciter/state")
    assert [state.applied_sample for state in states] == [0] * len(states)
    # Twenty revolutions, each faster than the one before.
    frequencies = list(dict.fromkeys(state.frequency for state in states))
    assert frequencies == sorted(frequencies)
    assert len(frequencies) == 20
    assert states[-1].force_amplitude == pytest.approx(
        3200.0 * states[-1].amplitude * (2 * math.pi * frequencies[-1]) ** 2
    )


def test_a_standing_roller_goes_on_publishing() -> None:
    roller = emulator(exciter__vibrate=False)
    messages = after(roller, 10 * 128)  # 1 s at the sampling floor
    assert len(of(messages, "drum/acceleration")) == 80
    assert len(of(messages, "meter")) == 10
    assert all(math.isnan(value.data) for value in of(messages, "cmv"))
    assert len(of(messages, "exciter/state")) == 10


def test_what_took_effect_is_said_once_with_the_time_of_its_sample() -> None:
    roller = emulator()
    roller.advance(16)
    roller.command(vibrate=False, frequency_hz=28.0, amplitude_m=1.6e-3)
    messages = after(roller, 112)
    assert "applied" not in topics(messages)
    messages = after(roller, 256)
    (change,) = of(messages, "applied")
    assert (change.sample, change.name, change.text) == (128, "exciter.vibrate", "false")
    assert stamp_ns(change) == START_NS + round(1e9 / 28.0)
    state = of(messages, "exciter/state")[0]
    assert (state.vibrating, state.applied_sample) == (False, 128)


def test_facts_come_again_only_where_something_changed() -> None:
    roller = emulator()
    roller.advance(128)
    roller.change({"soil.shear_modulus_pa": 80e6})
    messages = after(roller, 256)
    assert "machine" not in topics(messages)
    (soil,) = of(messages, "soil")
    assert {"soil.shear_modulus_pa": "80000000.0"}.items() <= {
        item.key: item.value for item in soil.values
    }.items()
    # A command that asks for what already runs changes no fact.
    roller.command(vibrate=True, frequency_hz=28.0, amplitude_m=1.6e-3)
    messages = after(roller, 128)
    assert not {"machine", "soil", "applied"} & set(topics(messages))
    assert of(messages, "exciter/state")[0].applied_sample == 384


def test_a_refusal_is_said_with_the_next_block_and_until_a_command_is_accepted() -> None:
    roller = emulator()
    after(roller, 32)
    with pytest.raises(CommandRefused):
        roller.command(vibrate=True, frequency_hz=100.0, amplitude_m=1e-3)
    reason = "frequency 100 Hz: must be at most 80 Hz"
    assert roller.refusal == (Refusal.OUT_OF_RANGE, reason)
    (state,) = of(roller.advance(16), "exciter/state")
    assert (state.refusal_code, state.refusal_reason) == (Refusal.OUT_OF_RANGE, reason)
    assert (state.commanded_frequency, state.commanded_amplitude) == (28.0, 1.6e-3)
    assert topics(roller.advance(16)) == BLOCKS
    # The same once more is said once more.
    with pytest.raises(CommandRefused):
        roller.command(vibrate=True, frequency_hz=100.0, amplitude_m=1e-3)
    assert of(roller.advance(16), "exciter/state")[0].refusal_reason == reason
    roller.command(vibrate=True, frequency_hz=28.0, amplitude_m=1.6e-3)
    assert roller.refusal == (Refusal.NONE, "")
    (state,) = of(roller.advance(16), "exciter/state")
    assert (state.refusal_code, state.refusal_reason) == (Refusal.NONE, "")


def test_the_driver_may_refuse_for_reasons_of_its_own() -> None:
    roller = emulator()
    roller.advance(16)
    roller.refuse(Refusal.TIMEOUT, "no command for 2 s")
    (state,) = of(roller.advance(16), "exciter/state")
    assert (state.refusal_code, state.refusal_reason) == (Refusal.TIMEOUT, "no command for 2 s")


def test_a_refused_change_leaves_no_trace() -> None:
    roller = emulator()
    roller.advance(128)
    with pytest.raises(ParameterError, match="must be at least"):
        roller.change({"soil.shear_modulus_pa": 1.0})
    assert topics(roller.advance(64)) == BLOCKS


def test_imu_messages_are_made_only_when_asked_and_decimated() -> None:
    roller = emulator(pacing__imu_decimation=3)
    assert roller.imu_messages() == []
    assert "drum/imu" not in topics(roller.advance(16))
    found = roller.imu_messages()
    assert topics(found) == ["drum/imu"] * 6
    (acceleration,) = of(roller.advance(16), "drum/acceleration")
    imu = of(roller.imu_messages(), "drum/imu")
    assert len(imu) == 5
    assert imu[0].linear_acceleration.z == pytest.approx(float(acceleration.vertical[2]) + 9.81)
    assert imu[0].linear_acceleration.x == acceleration.horizontal[2]


@pytest.mark.parametrize("samples", [0, 129])
def test_a_bad_block_size_leaves_the_emulator_as_it_was(samples: int) -> None:
    roller = emulator()
    with pytest.raises(RollerSimError, match=rf"advance\({samples}\)"):
        roller.advance(samples)
    assert roller.block is None
    assert topics(roller.advance(128))[:3] == ["inputs", *BLOCKS]


def test_another_number_of_samples_per_revolution_is_refused() -> None:
    with pytest.raises(ParameterError, match="need 128 samples per revolution"):
        emulator(sampling__samples_per_revolution=256)


@pytest.mark.parametrize("what", ["command", "change", "refuse"])
def test_what_another_thread_asks_waits_for_the_block_under_way(
    what: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    roller = emulator()
    roller.advance(128)
    advance = roller.session.advance
    under_way, done = threading.Event(), threading.Event()

    def slowly(samples: int) -> Block:
        block = advance(samples)
        under_way.set()
        time.sleep(0.1)
        done.set()
        return block

    monkeypatch.setattr(roller.session, "advance", slowly)
    thread = threading.Thread(target=roller.advance, args=(128,))
    thread.start()
    assert under_way.wait(5.0)
    if what == "command":
        roller.command(vibrate=True, frequency_hz=28.0, amplitude_m=1e-3)
    elif what == "change":
        roller.change({"soil.shear_modulus_pa": 80e6})
    else:
        roller.refuse(Refusal.TIMEOUT, "no command")
    assert done.is_set()
    thread.join()


def test_what_comes_in_is_told_before_the_block_that_it_comes_before() -> None:
    roller = emulator(exciter__frequency_hz=31.0)
    (begin,) = of(roller.advance(16), "inputs")
    arguments = json.loads(begin.arguments)
    assert (begin.kind, begin.sample, stamp_ns(begin)) == ("begin", 0, START_NS)
    assert arguments["parameters"] == roller.session.configuration.flat()
    assert arguments["start_ns"] == START_NS
    roller.advance(16)
    roller.change({"exciter.frequency_hz": 29})
    roller.command_travel(1)
    for refused in (-1.0, math.nan):
        with pytest.raises(CommandRefused):
            roller.command(vibrate=True, frequency_hz=refused, amplitude_m=1e-3)
        with pytest.raises(CommandRefused):
            roller.command_travel(refused * 99.0)
    with pytest.raises(ParameterError):
        roller.change({"machine.drum_mass_kg": 1.0})
    roller.release()
    told = of(roller.advance(16), "inputs")
    assert [(item.kind, item.sample) for item in told] == [
        *(("change", 32), ("travel", 32), ("refuse", 32), ("refuse", 32), ("release", 32))
    ]
    assert told[0].arguments == '{"values": {"exciter.frequency_hz": 29.0}}'
    assert told[1].arguments == '{"speed_m_s": 1.0}'
    assert of(roller.advance(16), "inputs") == []


def test_what_a_frozen_link_loses_never_came_in() -> None:
    roller = emulator()
    roller.inject("frozen_command_link")
    roller.advance(128)
    roller.command(vibrate=True, frequency_hz=math.nan, amplitude_m=1e-3)
    roller.command_travel(math.inf)
    assert of(roller.advance(128), "inputs") == []
