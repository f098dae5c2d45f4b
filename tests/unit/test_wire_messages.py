# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Messages decode to the values that went in, and the template equals what the library makes."""

import math

import numpy as np
import pytest

from roller_sim_ros.meters import MeterValue, Mode, Status, TruthValue
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sensors import IdealAccelerometer, Kind
from roller_sim_ros.session import (
    Applied,
    Block,
    ExciterCommand,
    ExciterStatus,
    Master,
    Refusal,
)
from roller_sim_ros.site import Position
from roller_sim_ros.wire import messages, topics
from roller_sim_ros.wire.imu import imu
from roller_sim_ros.wire.types import decode, encode, typestore

START_NS = 1_700_000_000_123_456_789


def make_block(count: int = 16, *, first_sample: int = 32, depth: float = 0.0) -> Block:
    rng = np.random.default_rng(1)
    soil = -rng.random(count) * 1e-3
    plastic = rng.random(count) * 1e-3
    datum = np.full(count, depth)
    return Block(
        first_sample=first_sample,
        time_s=first_sample / 3584.0,
        sample_period_s=1 / 3584.0,
        excitation_hz=28.0,
        eccentric_phase_rad=1.5,
        phase_increment_rad=2 * math.pi / 128,
        acceleration_vertical=rng.normal(size=count) * 50,
        acceleration_horizontal=rng.normal(size=count) * 50,
        soil_force=rng.random(count) * 3e5,
        drum_height=soil - plastic - datum,
        soil_displacement=soil,
        plastic_depth=plastic,
        height_datum=datum,
        contact_state=rng.integers(0, 3, count).astype(np.uint8),
        shear_modulus_pa=35e6,
        plastic_parameter_m=1e-3,
    )


def read(message: messages.Message):
    return decode(message.data, message.type_name)


def constants(type_name: str) -> dict[str, int]:
    return {name: value for name, _, value in typestore().fielddefs[type_name][0]}


def nanoseconds(stamp) -> int:
    return stamp.sec * 1_000_000_000 + stamp.nanosec


def test_drum_acceleration_is_what_the_sensor_delivered() -> None:
    block = make_block()
    (reading,) = IdealAccelerometer().read(block)
    message = messages.drum_acceleration(reading, START_NS)
    got = read(message)
    assert (message.topic, message.type_name) == (
        "drum/acceleration",
        "roller_sim_ros/msg/DrumAcceleration",
    )
    assert got.header.frame_id == "drum_axle"
    assert nanoseconds(got.header.stamp) == message.stamp_ns == START_NS + round(block.time_s * 1e9)
    assert got.kind == constants(message.type_name)["COORDINATE_ACCELERATION"]
    assert got.sequence == 32
    assert got.sample_period == block.sample_period_s
    assert got.excitation_frequency == 28.0
    assert got.eccentric_phase == 1.5
    assert got.phase_increment == block.phase_increment_rad
    np.testing.assert_array_equal(got.vertical, block.acceleration_vertical.astype(np.float32))
    np.testing.assert_array_equal(got.horizontal, block.acceleration_horizontal.astype(np.float32))
    assert (got.scale, got.clipped, len(got.raw_vertical), len(got.raw_horizontal)) == (0, 0, 0, 0)
    assert got.sensor_time == block.time_s


@pytest.mark.parametrize("depth", [0.0, 0.3, 1234.5])
def test_heights_keep_their_resolution_however_deep_the_drum_is(depth: float) -> None:
    block = make_block(depth=depth)
    got = read(messages.drum_soil_state(block, TruthValue(), START_NS))
    height = got.datum + got.drum_height.astype(np.float64)
    # Half a unit of single precision at 2 mm, and double precision at the depth itself.
    np.testing.assert_allclose(
        height, block.drum_height, rtol=0, atol=2e-3 * 2**-24 + depth * 4e-16
    )
    assert got.datum == -depth


def test_truth_carries_the_block_and_the_true_values() -> None:
    block = make_block(8)
    truth = TruthValue(255, 50.0, 12.0, 0.25, 3.5, 2, 1, Mode.DOUBLE_JUMP)
    got = read(messages.drum_soil_state(block, truth, START_NS))
    for name, values in {
        "vertical": block.acceleration_vertical,
        "horizontal": block.acceleration_horizontal,
        "soil_force": block.soil_force,
        "soil_displacement": block.soil_displacement,
        "plastic_depth": block.plastic_depth,
    }.items():
        np.testing.assert_array_equal(getattr(got, name), values.astype(np.float32), err_msg=name)
    np.testing.assert_array_equal(got.contact_state, block.contact_state)
    assert (got.shear_modulus, got.plastic_parameter) == (35e6, 1e-3)
    assert (got.cmv, got.rmv, got.air_fraction, got.force_ratio_max) == (50.0, 12.0, 0.25, 3.5)
    assert (got.period, got.blows_per_period) == (2, 1)
    assert got.mode == constants("roller_sim_ros/msg/DrumSoilState")["DOUBLE_JUMP"]


def test_meter_and_cmv() -> None:
    value = MeterValue(
        2047, 16, 42.5, 3.0, 28.0, 55.0, -0.5, 1, Mode.PARTIAL_UPLIFT, Status.GAP | Status.STANDING
    )
    got = read(messages.compaction_meter(value, START_NS))
    assert nanoseconds(got.header.stamp) == START_NS
    assert (got.last_sample, got.window_revolutions, got.cmv, got.rmv) == (2047, 16, 42.5, 3.0)
    assert (got.excitation_frequency, got.fundamental_amplitude) == (28.0, 55.0)
    assert got.fundamental_phase == -0.5
    names = constants("roller_sim_ros/msg/CompactionMeter")
    assert (got.period, got.mode) == (1, names["PARTIAL_UPLIFT"])
    assert got.status == names["GAP"] | names["STANDING"]
    assert read(messages.cmv(value, START_NS)).data == 42.5


def test_the_enumerations_are_those_of_the_messages() -> None:
    masters = {f"MASTER_{item.name}": item.value for item in Master}
    exciter = constants("roller_sim_ros/msg/ExciterState")
    assert exciter == {item.name: item.value for item in Refusal} | masters
    assert constants("roller_sim_ros/msg/AppliedChange") == masters
    levels = constants("diagnostic_msgs/msg/DiagnosticStatus")
    assert levels == {item.name: item.value for item in messages.Level}
    kinds = constants("roller_sim_ros/msg/DrumAcceleration")
    assert kinds == {item.name: item.value for item in Kind}
    meter = constants("roller_sim_ros/msg/CompactionMeter")
    assert {k: v for k, v in meter.items() if k in Status.__members__} == {
        item.name: item.value for item in Status if item.value
    }
    modes = {"MODE_UNKNOWN" if mode is Mode.UNKNOWN else mode.name: mode.value for mode in Mode}
    assert {name: meter[name] for name in modes} == modes
    assert constants("roller_sim_ros/msg/SiteState") == modes | masters


def test_exciter_state_and_command() -> None:
    status = ExciterStatus(
        vibrating=True,
        commanded_frequency_hz=30.0,
        commanded_amplitude_m=1e-3,
        frequency_hz=28.0,
        amplitude_m=0.8e-3,
        force_amplitude_n=1.5e5,
        applied_sample=256,
        master=Master.COMMAND,
    )
    reason = "frequency 99 Hz: must be at most 80 Hz"
    got = read(messages.exciter_state(status, START_NS, Refusal.OUT_OF_RANGE, reason))
    assert got.vibrating
    assert (got.commanded_frequency, got.commanded_amplitude) == (30.0, 1e-3)
    assert (got.frequency, got.amplitude, got.force_amplitude) == (28.0, 0.8e-3, 1.5e5)
    assert (got.applied_sample, got.refusal_code, got.refusal_reason) == (256, 3, reason)
    assert got.master == 2
    accepted = read(messages.exciter_state(status, START_NS))
    assert (accepted.refusal_code, accepted.refusal_reason) == (0, "")
    command = read(messages.exciter_command(ExciterCommand(False, 28.0, 1.6e-3), START_NS))
    assert (command.vibrate, command.frequency, command.amplitude) == (False, 28.0, 1.6e-3)


@pytest.mark.parametrize(
    ("value", "number", "text"),
    [(80e6, 80e6, ""), (7, 7.0, ""), (True, math.nan, "true"), ("exact", math.nan, "exact")],
)
def test_applied_change_takes_any_value(value, number: float, text: str) -> None:
    change = Applied(384, "soil.shear_modulus_pa", value, Master.SCENARIO)
    got = read(messages.applied_change(change, START_NS))
    assert (got.sample, got.name, got.text) == (384, "soil.shear_modulus_pa", text)
    assert got.master == 1
    np.testing.assert_equal(got.value, number)


def test_site_state_is_of_the_revolution_that_ends() -> None:
    block = make_block(first_sample=112)
    truth = TruthValue(127, cmv=37.5, mode=Mode.DOUBLE_JUMP)
    position = Position(12.5, 3, -1.25, finished=True)
    message = messages.site_state(
        block, position, truth, (Master.COMMAND, Master.CMD_VEL), START_NS
    )
    got = read(message)
    assert message.topic == "site/state"
    assert nanoseconds(got.header.stamp) == START_NS + round(
        (block.time_s + 15 * block.sample_period_s) * 1e9
    )
    assert (got.last_sample, got.chainage, got.pass_number, got.speed) == (127, 12.5, 3, -1.25)
    assert (got.finished, got.cmv, got.mode) == (True, 37.5, 3)
    assert (got.shear_modulus, got.plastic_parameter) == (35e6, 1e-3)
    assert (got.exciter_master, got.travel_master) == (2, 3)


def test_diagnostics() -> None:
    entry = messages.Diagnostic(
        "pacing", messages.Level.WARN, "late", {"late_blocks": 3, "on": True}, "/roller"
    )
    got = read(messages.diagnostic_array([entry, messages.Diagnostic("recorder")], START_NS))
    assert nanoseconds(got.header.stamp) == START_NS
    first, second = got.status
    assert (first.level, first.name, first.message) == (1, "pacing", "late")
    assert first.hardware_id == "/roller"
    assert [(pair.key, pair.value) for pair in first.values] == [
        ("late_blocks", "3"),
        ("on", "true"),
    ]
    assert (second.name, second.level, second.values) == ("recorder", 0, [])


def test_facts_name_every_parameter_and_lose_no_digit() -> None:
    configuration = Configuration().changed({"soil.shear_modulus_pa": 81.23456789e6})
    soil = read(messages.soil_facts(configuration, START_NS))
    machine = read(messages.machine_facts(configuration, START_NS))
    facts = {pair.key: pair.value for pair in [*soil.values, *machine.values]}
    flat = configuration.flat()
    aside = ("pacing", "recording", "scenario")
    physical = [name for name in flat if name.partition(".")[0] not in aside]
    assert sorted(facts) == sorted(physical)
    assert float(facts["soil.shear_modulus_pa"]) == 81.23456789e6
    assert (soil.name, machine.name) == ("soil", "machine")


def test_parameter_event_states_every_kind_of_value() -> None:
    values = {"a": True, "b": 3, "c": 2.5, "d": "text"}
    got = read(messages.parameter_event("/roller", values, START_NS))
    assert got.node == "/roller"
    assert [(item.name, item.value.type) for item in got.new_parameters] == [
        ("a", 1),
        ("b", 2),
        ("c", 3),
        ("d", 4),
    ]
    a, b, c, d = (item.value for item in got.new_parameters)
    assert (a.bool_value, b.integer_value, c.double_value, d.string_value) == (True, 3, 2.5, "text")


@pytest.mark.parametrize("kind", list(Kind))
def test_imu_is_specific_force_and_what_the_library_would_write(kind: Kind) -> None:
    block = make_block(16, first_sample=48)
    (reading,) = IdealAccelerometer(kind).read(block)
    batch = imu(reading, START_NS)
    assert len(batch) == 16
    for index, message in enumerate(batch):
        got = read(message)
        assert bytes(encode(got, message.type_name)) == message.data
        stamp = START_NS + round((block.time_s + index * block.sample_period_s) * 1e9)
        assert nanoseconds(got.header.stamp) == message.stamp_ns == stamp
        assert got.header.frame_id == "drum_axle"
        assert got.linear_acceleration.z == pytest.approx(
            block.acceleration_vertical[index] + 9.81, rel=1e-6, abs=1e-5
        )
        assert got.linear_acceleration.x == np.float32(block.acceleration_horizontal[index])
        assert got.linear_acceleration.y == 0.0
        assert got.orientation_covariance[0] == got.angular_velocity_covariance[0] == -1.0
        assert not got.linear_acceleration_covariance.any()


@pytest.mark.parametrize("first_sample", [0, 48, 53])
def test_imu_decimation_counts_samples_of_the_session(first_sample: int) -> None:
    block = make_block(16, first_sample=first_sample)
    (reading,) = IdealAccelerometer().read(block)
    every = imu(reading, START_NS)
    expected = [every[i] for i in range(16) if (first_sample + i) % 5 == 0]
    assert imu(reading, START_NS, decimation=5) == expected


def test_resolved_names() -> None:
    assert topics.ACCELERATION.resolved() == "/drum/acceleration"
    assert topics.ACCELERATION.resolved("/north/") == "/north/drum/acceleration"
    assert topics.DIAGNOSTICS.resolved("north") == "/diagnostics"
