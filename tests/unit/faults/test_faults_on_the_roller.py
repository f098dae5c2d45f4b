# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Each fault on the whole roller: what goes out, what the built-in meter makes of it, and that truth stays truth."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.faults import FAULTS, Behaviour, FaultRefused, Span, Stage, make_fault
from roller_sim_ros.parameters import Configuration, ParameterError, Value
from roller_sim_ros.sensors import Choice
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import decode

SOFT = {
    "soil.shear_modulus_pa": 35e6,
    "soil.plastic_parameter_m": 0.8e-3,
    "half_space.model": "two-pole",
}
ALL = (Choice("ideal"), Choice("tacho"), Choice("odometry"), Choice("gnss"))
SENSOR_FAULTS = [name for name, fault in FAULTS.items() if fault.stage is not Stage.EXCITER]


def roller(sensors: Iterable[Choice] = ALL) -> Emulator:
    return Emulator(Configuration().changed(SOFT), start_ns=0, sensors=tuple(sensors), seed=7)


def run(emulator: Emulator, revolutions: int, size: int = 128) -> list[Message]:
    return [message for _ in range(revolutions * 128 // size) for message in emulator.advance(size)]


def of(messages: Iterable[Message], topic: str) -> list[Any]:
    return [decode(item.data, item.type_name) for item in messages if item.topic == topic]


def vertical(messages: Iterable[Message]) -> NDArray[np.float32]:
    return np.concatenate([item.vertical for item in of(messages, "drum/acceleration")])


def with_and_without(
    fault: str, parameters: Mapping[str, Value] | None = None, revolutions: int = 6
) -> tuple[list[Message], list[Message]]:
    """Return what comes with a fault and without it, from its first revolution on."""
    found = []
    for faulty in (True, False):
        emulator = roller()
        run(emulator, 2)
        if faulty:
            emulator.inject(fault, parameters)
        found.append(run(emulator, revolutions))
    return found[0], found[1]


@pytest.mark.parametrize("fault", SENSOR_FAULTS)
def test_truth_is_never_touched_by_a_sensor_fault(fault: str) -> None:
    digests = [
        hashlib.sha256(b"".join(it.data for it in messages if it.topic == "truth")).hexdigest()
        for messages in with_and_without(fault)
    ]
    assert digests[0] == digests[1]


@pytest.mark.parametrize(
    "fault", [name for name in SENSOR_FAULTS if name not in ("frozen_command_link", "delay")]
)
def test_every_sensor_fault_changes_something(fault: str) -> None:
    own = ("drum/acceleration", "tacho", "odom", "fix")
    faulty, sound = (
        [item for item in messages if item.topic in own]
        for messages in with_and_without(fault, revolutions=12)
    )
    assert faulty != sound


def test_stuck_repeats_the_last_reading_of_the_axis() -> None:
    emulator = roller()
    last = vertical(run(emulator, 2))[-1]
    emulator.inject("stuck", {"axis": "vertical"})
    faulty = run(emulator, 2, size=16)
    assert np.all(vertical(faulty) == last)
    (first, *_) = of(faulty, "drum/acceleration")
    assert np.ptp(first.horizontal) > 1.0


def test_bias_gain_and_saturation_do_what_they_say() -> None:
    for fault, parameters, expected in (
        ("bias_step", {"bias_m_s2": 3.0}, lambda true: true + 3.0),
        ("gain_change", {"factor": 0.5}, lambda true: true * 0.5),
        ("saturation", {"limit_m_s2": 30.0}, lambda true: np.clip(true, -30.0, 30.0)),
    ):
        faulty, sound = with_and_without(fault, parameters)
        assert vertical(faulty) == pytest.approx(expected(vertical(sound)), abs=1e-4)
    clipped = sum(item.clipped for item in of(faulty, "drum/acceleration"))
    assert clipped == sum(
        int((np.abs(axis) > 30.0).sum())
        for item in of(sound, "drum/acceleration")
        for axis in (item.vertical, item.horizontal)
    )
    assert clipped > 0


def test_spikes_are_as_many_and_as_high_as_they_should_be() -> None:
    faulty, sound = with_and_without("spike", {"probability": 0.01, "height_m_s2": 80.0}, 100)
    off = vertical(faulty) - vertical(sound)
    hit = np.abs(off) > 1.0
    # Of 12800 samples 128 are hit, give or take five times √128.
    assert abs(hit.sum() - 128) < 57
    assert np.abs(off[hit]) == pytest.approx(80.0, abs=1e-3)
    assert 0.2 < np.mean(off[hit] > 0.0) < 0.8


def test_a_noise_burst_has_its_deviation() -> None:
    faulty, sound = with_and_without("noise_burst", {"deviation_m_s2": 1.5}, 60)
    off = vertical(faulty) - vertical(sound)
    assert np.std(off) == pytest.approx(1.5, rel=5.0 / math.sqrt(2.0 * len(off)))


def test_dropped_samples_leave_gaps_of_the_stretch() -> None:
    faulty, sound = with_and_without("dropout", {"stretch_samples": 32, "probability": 0.4}, 40)
    found = np.concatenate(
        [item.sequence + np.arange(len(item.vertical)) for item in of(faulty, "drum/acceleration")]
    )
    every = np.arange(2 * 128, 42 * 128)
    lost = np.setdiff1d(every, found)
    assert len(np.unique(found)) == len(found)
    # Whole stretches, and four of ten of 160, give or take five times √(160 · 0.24).
    assert np.array_equal(np.unique(lost // 32 * 32 + np.arange(32)[:, None]), lost)
    assert abs(len(lost) / 32 - 64) < 31
    true = dict(zip(every.tolist(), vertical(sound).tolist(), strict=True))
    assert vertical(faulty).tolist() == [true[int(index)] for index in found]


def test_late_messages_come_late_and_in_order_with_their_stamps() -> None:
    emulator = roller()
    run(emulator, 2)
    emulator.inject("delay", {"delay_s": 0.1}, span=Span(revolutions=5))
    arrivals = []
    for _ in range(30):
        for message in emulator.advance(128):
            if message.topic == "drum/acceleration":
                block = emulator.block
                assert block is not None
                arrivals.append(
                    (
                        decode(message.data, message.type_name).sequence // 128,
                        block.first_sample // 128,
                    )
                )
    assert [sequence for sequence, _ in arrivals] == list(range(2, 32))
    # 0.1 s are 2.8 revolutions: three later.
    late = [now - sequence for sequence, now in arrivals]
    assert late[:5] == [3] * 5
    assert late[-1] == 0


@pytest.mark.parametrize("size", [16, 128])
def test_messages_come_twice_or_in_the_wrong_order(size: int) -> None:
    faulty, _ = with_and_without("duplicate", {"probability": 1.0}, 3)
    assert [item.sequence for item in of(faulty, "drum/acceleration")] == [
        256, 256, 384, 384, 512, 512,
    ]  # fmt: skip
    emulator = roller()
    run(emulator, 2)
    emulator.inject("reordered", {"probability": 1.0}, span=Span(revolutions=1))
    order = np.concatenate(
        [
            item.sequence + np.arange(len(item.vertical))
            for item in of(run(emulator, 4, size), "drum/acceleration")
        ]
    )
    expected = np.concatenate([np.arange(384, 512), np.arange(256, 384), np.arange(512, 768)])
    assert np.array_equal(order, expected)


def test_a_skewed_clock_runs_off_and_stays_off_when_it_is_right_again() -> None:
    emulator = roller()
    run(emulator, 2)
    handle = emulator.inject("clock_skew", {"skew_ppm": 1000.0})
    readings = of(run(emulator, 10), "drum/acceleration")
    emulator.clear(handle)
    readings += of(run(emulator, 5), "drum/acceleration")
    ahead_s = [
        item.sensor_time - item.header.stamp.sec - item.header.stamp.nanosec * 1e-9
        for item in readings
    ]
    assert ahead_s[:11] == pytest.approx([1e-3 * k / 28.0 for k in range(11)], abs=2e-9)
    assert ahead_s[11:] == pytest.approx([1e-3 * 10 / 28.0] * 4, abs=2e-9)


def test_lost_pulses_are_not_counted() -> None:
    faulty, sound = with_and_without("lost_pulse", {"probability": 0.5}, 200)
    assert len(of(sound, "tacho")) == 200
    pulses = of(faulty, "tacho")
    assert abs(len(pulses) - 100) < 36  # five times √50
    assert [pulse.sequence for pulse in pulses] == list(range(3, 3 + len(pulses)))


@pytest.mark.parametrize(("what", "topic"), [("position", "fix"), ("speed", "odom")])
@pytest.mark.parametrize("new_stamps", [True, False])
def test_a_stale_position_repeats_the_last_one(what: str, topic: str, new_stamps: bool) -> None:
    emulator = roller()
    emulator.command_travel(1.0)
    before = of(run(emulator, 28), topic)
    emulator.inject("stale_position", {"what": what, "new_stamps": new_stamps})
    after = of(run(emulator, 28), topic)
    last = before[-1]

    def value(message: Any) -> Any:
        if topic == "fix":
            return (message.latitude, message.longitude, message.altitude)
        return (message.pose.pose.position.x, message.twist.twist.linear.x)

    assert value(before[-2]) != value(last)
    assert {value(message) for message in after} == {value(last)}
    stamps = {(message.header.stamp.sec, message.header.stamp.nanosec) for message in after}
    assert len(stamps) == (len(after) if new_stamps else 1)


def test_a_frozen_link_loses_commands_and_a_thawed_one_does_not() -> None:
    emulator = roller()
    handle = emulator.inject("frozen_command_link")
    run(emulator, 1)
    emulator.command(vibrate=True, frequency_hz=30.0, amplitude_m=1e-3)
    emulator.command_travel(1.0)
    run(emulator, 2)
    assert emulator.session.exciter_status().commanded_frequency_hz == 28.0
    assert emulator.session.site.position.speed_m_s == 0.0
    emulator.clear(handle)
    run(emulator, 1)
    emulator.command(vibrate=True, frequency_hz=30.0, amplitude_m=1e-3)
    run(emulator, 1)
    assert emulator.session.exciter_status().commanded_frequency_hz == 30.0


def test_an_exciter_that_does_not_obey() -> None:
    amplitudes, frequencies = {}, {}
    for fault in ("stuck_amplitude", "slow_run_up", "frequency_droop", None):
        emulator = roller()
        run(emulator, 2)
        if fault:
            emulator.inject(fault, {"factor": 0.1} if fault == "slow_run_up" else {})
        run(emulator, 1)
        emulator.command(vibrate=True, frequency_hz=30.0, amplitude_m=1.0e-3)
        run(emulator, 60)
        status = emulator.session.exciter_status()
        assert (status.commanded_frequency_hz, status.commanded_amplitude_m) == (30.0, 1.0e-3)
        amplitudes[fault], frequencies[fault] = status.amplitude_m, status.frequency_hz
    assert (amplitudes[None], frequencies[None]) == (1.0e-3, 30.0)
    assert (amplitudes["stuck_amplitude"], frequencies["stuck_amplitude"]) == (1.6e-3, 30.0)
    assert 1.0e-3 < amplitudes["slow_run_up"] < 1.4e-3
    assert amplitudes["frequency_droop"] == 1.0e-3
    assert 28.0 < frequencies["frequency_droop"] < 29.9


def test_the_droop_follows_the_power_of_the_revolution_before() -> None:
    emulator = roller()
    run(emulator, 100)
    emulator.inject("frequency_droop", {"droop_hz_per_kw": 0.05})
    before = run(emulator, 1)
    force, height = (
        np.concatenate([getattr(it, name) for it in of(before, "truth")]).astype(float)
        for name in ("soil_force", "drum_height")
    )
    datum = np.concatenate([np.full(len(it.vertical), it.datum) for it in of(before, "truth")])
    block = emulator.block
    assert block is not None
    power_w = -((force[1:] + force[:-1]) / 2.0 * np.diff(height + datum)).sum() / (
        127 * block.sample_period_s
    )
    run(emulator, 1)
    block = emulator.block
    assert block is not None
    assert power_w > 1e3
    # 10 Hz/s is the drive's limit; the loss is within it.
    assert block.excitation_hz == pytest.approx(28.0 - 0.05 * power_w / 1e3, abs=2e-3)


@pytest.mark.parametrize("fault", FAULTS)
def test_the_built_in_meter_does_what_each_fault_expects(fault: str) -> None:
    emulator = roller()
    run(emulator, 60)
    emulator.inject(fault)
    expected = make_fault(fault).expectation()
    values = []
    for revolution in range(40):
        messages = emulator.advance(128)
        values += [(revolution, item, emulator.truth_value.cmv) for item in of(messages, "meter")]
    flagged = [revolution for revolution, item, _ in values if item.status or math.isnan(item.cmv)]
    off = [
        abs(item.cmv / true - 1.0) * 100.0
        for _, item, true in values
        if not item.status and not math.isnan(item.cmv)
    ]
    if expected.behaviour is Behaviour.UNAFFECTED:
        assert max(off, default=0.0) <= expected.tolerance_percent
    else:
        assert flagged
        assert flagged[0] <= expected.within_revolutions
    if expected.behaviour is Behaviour.NAN:
        assert all(
            math.isnan(item.cmv)
            for revolution, item, _ in values
            if revolution > expected.within_revolutions
        )


def test_faults_are_told_with_parameters_and_expectation_and_when_they_end() -> None:
    emulator = roller()
    (first,) = of(run(emulator, 2), "faults")
    assert (list(first.faults), first.sample) == ([], 0)
    handle = emulator.inject("bias_step", {"bias_m_s2": 1.5}, span=Span(duration_s=0.1))
    (begun, ended) = of(run(emulator, 6), "faults")
    (fault,) = begun.faults
    assert (fault.handle, fault.id, fault.stage, fault.live) == (
        handle,
        "bias_step",
        "signal",
        True,
    )
    assert (begun.sample, fault.since_sample) == (256, 256)
    assert dict(zip(fault.parameter_names, fault.parameter_values, strict=True)) == {
        "axis": "both",
        "bias_m_s2": "1.5",
    }
    assert (fault.expected, fault.tolerance_percent) == (Behaviour.UNAFFECTED, 1.5)
    # 0.1 s are 2.8 revolutions.
    assert (list(ended.faults), ended.sample) == ([], 256 + 3 * 128)


def test_what_cannot_be_is_refused_with_the_reason_and_leaves_no_trace() -> None:
    emulator = roller([Choice("mems_10g")])
    emulator.inject("noise_burst")
    for fault, parameters, message in (
        ("noise_burts", {}, "did you mean noise_burst"),
        ("noise_burst", {}, "cannot be active twice; clear handle 1 first"),
        ("stuck", {}, "a reading that is stuck shows nothing of it"),
        ("lost_pulse", {}, "there is no sensor for the pulses of the eccentric"),
        ("stale_position", {}, "there is no sensor for the position by satellite"),
        ("saturation", {"limit_m_s2": 150.0}, "range ends at 98.0665"),
    ):
        with pytest.raises(FaultRefused, match=message):
            emulator.inject(fault, parameters)
    with pytest.raises(ParameterError, match=r"bias_m_s2 = inf: must be finite"):
        emulator.inject("bias_step", {"bias_m_s2": math.inf})
    with pytest.raises(ParameterError, match=r"bias = 1.0: there is no such parameter; did you"):
        emulator.inject("bias_step", {"bias": 1.0})
    with pytest.raises(FaultRefused, match="no fault with the handle 9; there are 1"):
        emulator.clear(9)
    (told,) = of(run(emulator, 3), "faults")
    assert [fault.id for fault in told.faults] == ["noise_burst"]
    emulator.clear()
    (told,) = of(run(emulator, 2), "faults")
    assert list(told.faults) == []
