# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The topics as a subscriber sees them: qualities of service, the late comer, the standing roller, the IMU."""

from __future__ import annotations

import math
from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Imu
from std_msgs.msg import Float64

from roller_sim_ros.msg import CompactionMeter, DrumAcceleration, DrumSoilState, ExciterState
from roller_sim_ros.parameters import Pacing
from roller_sim_ros.wire.topics import TOPICS, Direction
from tests.integration.harness import entry, recorded, values

LASTING = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def offered(find, name):
    return [item for item in find(name) if item.node_name == "roller_sim"]


def test_every_topic_is_offered_as_the_table_says(visitor):
    visitor.spin_until(lambda: visitor.node.count_publishers("/drum/acceleration"))
    for topic in TOPICS:
        if topic.direction is Direction.RECORDED or topic.of_simulated_time:
            continue
        published = topic.direction is Direction.PUBLISHED
        find = (
            visitor.node.get_publishers_info_by_topic
            if published
            else visitor.node.get_subscriptions_info_by_topic
        )
        (info,) = visitor.spin_until(partial(offered, find, topic.resolved()))
        assert info.topic_type == topic.type_name
        wanted = topic.qos(Pacing())
        assert info.qos_profile.reliability.name.lower() == wanted.reliability
        assert info.qos_profile.durability.name.lower() == wanted.durability
        depth = f"qos_overrides.{topic.resolved()}.{'publisher' if published else 'subscription'}"
        assert visitor.get_parameter(f"{depth}.depth") == wanted.depth


@pytest.mark.parametrize("reliability", [ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT])
def test_both_kinds_of_reader_match(visitor, reliability):
    blocks = visitor.listen(
        "drum/acceleration", DrumAcceleration, QoSProfile(depth=1000, reliability=reliability)
    )
    visitor.spin_until(lambda: len(blocks) > 50)
    if reliability == ReliabilityPolicy.RELIABLE:
        assert all(b.sequence == a.sequence + 16 for a, b in pairwise(blocks))


def test_facts_reach_the_late_comer(visitor):
    # The shared roller has been running, and its facts were told, for some time.
    soil = visitor.listen("soil", DiagnosticStatus, LASTING)
    machine = visitor.listen("machine", DiagnosticStatus, LASTING)
    visitor.spin_until(lambda: soil and machine)
    ground = {item.key: item.value for item in soil[-1].values}
    assert float(ground["soil.shear_modulus_pa"]) == visitor.get_parameter("soil.shear_modulus_pa")
    roller = {item.key: item.value for item in machine[-1].values}
    assert float(roller["machine.drum_mass_kg"]) == 3200.0


def test_truth_and_acceleration_go_side_by_side(visitor):
    blocks = visitor.listen("drum/acceleration", DrumAcceleration)
    truth = visitor.listen("truth", DrumSoilState)
    visitor.spin_until(lambda: len(blocks) > 20 and len(truth) > 20)
    others = {item.sequence: item for item in truth}
    together = [block for block in blocks if block.sequence in others]
    assert len(together) > 10
    for block in together:
        other = others[block.sequence]
        assert block.header == other.header
        assert block.header.frame_id == "drum_axle"
        assert block.vertical == other.vertical
        assert block.horizontal == other.horizontal
        assert block.eccentric_phase == other.eccentric_phase
        assert len(other.contact_state) == len(block.vertical)
        assert min(other.soil_force) >= 0.0


def test_stamps_are_the_accumulated_periods(visitor):
    blocks = visitor.listen("drum/acceleration", DrumAcceleration)
    visitor.spin_until(lambda: len(blocks) > 300)

    def nanoseconds(block) -> int:
        return block.header.stamp.sec * 10**9 + block.header.stamp.nanosec

    for before, after in pairwise(blocks):
        step = nanoseconds(after) - nanoseconds(before)
        assert abs(step - 16e9 * before.sample_period) <= 1.0


def test_diagnostics_tell_the_state(visitor):
    diagnostics = visitor.listen("/diagnostics", DiagnosticArray)
    visitor.spin_until(lambda: len(diagnostics) >= 2)
    pacing = values(entry(diagnostics, "pacing"))
    assert float(pacing["sample_rate_hz"]) == pytest.approx(28.0 * 128)
    assert 0.0 <= float(pacing["lateness_p50_s"]) <= float(pacing["lateness_p99_s"])
    assert float(pacing["lateness_p99_s"]) <= float(pacing["lateness_max_s"])
    assert int(pacing["late_blocks"]) >= 0
    visitor.spin_until(
        lambda: (
            float(values(entry(diagnostics, "pacing"))["real_time_factor"])
            == pytest.approx(1.0, abs=0.2)
        )
    )
    assert entry(diagnostics, "recording").message == "nothing is recorded"
    assert entry(diagnostics, "exciter").name == "/roller_sim: exciter"

    # Once a second.
    def apart() -> float:
        before, after = (item.header.stamp for item in diagnostics[-2:])
        return after.sec - before.sec + 1e-9 * (after.nanosec - before.nanosec)

    visitor.spin_until(lambda: apart() == pytest.approx(1.0, abs=0.5))


def test_imu_is_there_for_those_who_listen(visitor):
    blocks = visitor.listen("drum/acceleration", DrumAcceleration)
    imu = visitor.listen("drum/imu", Imu, QoSProfile(depth=5000))
    visitor.spin_until(lambda: len(imu) > 2000)
    visitor.spin_for(0.2)
    samples = {}
    for block in blocks:
        start = block.header.stamp.sec * 10**9 + block.header.stamp.nanosec
        for index, vertical in enumerate(block.vertical):
            samples[start + round(index * block.sample_period * 1e9)] = (
                vertical,
                block.horizontal[index],
            )
    found = 0
    for message in imu:
        stamp = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
        for near in (stamp - 1, stamp, stamp + 1):
            if near in samples:
                vertical, horizontal = samples[near]
                assert message.linear_acceleration.z == pytest.approx(vertical + 9.81)
                assert message.linear_acceleration.x == pytest.approx(horizontal)
                found += 1
                break
    assert found > 1000
    assert message.orientation_covariance[0] == -1.0
    assert message.angular_velocity_covariance[0] == -1.0


def test_imu_is_decimated_and_not_made_for_nobody(start, client, tmp_path):
    bag = tmp_path / "trace.mcap"
    sim = start(
        *("--record", str(bag), "--ros-args", "-p", "pacing.imu_decimation:=8"),
        *("-p", "exciter.frequency_rate_hz_per_s:=1000.0"),
    )
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    client.spin_until(lambda: blocks and blocks[-1].sequence > 2000)
    imu = client.listen("drum/imu", Imu)
    client.spin_until(lambda: len(imu) > 500)
    stamps = [item.header.stamp.sec * 10**9 + item.header.stamp.nanosec for item in imu]
    steps = np.diff(stamps)
    assert np.abs(steps - 8e9 / (28.0 * 128)).max() <= 1.0
    client.listen_no_more()
    assert sim.end() == 0
    # The bag has it from when someone listened.
    in_bag = recorded(bag, "/drum/imu")
    assert len(imu) <= len(in_bag) < recorded(bag, "/drum/acceleration")[-1].sequence / 8 - 100


def test_standing_roller_keeps_publishing(start, client):
    sim = start("--ros-args", "-p", "exciter.vibrate:=false")
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    meter = client.listen("meter", CompactionMeter)
    cmv = client.listen("cmv", Float64)
    truth = client.listen("truth", DrumSoilState)
    states = client.listen("exciter/state", ExciterState)
    client.spin_until(lambda: len(meter) > 20 and len(cmv) > 20)
    for value in meter:
        assert value.status & CompactionMeter.STANDING
        assert math.isnan(value.cmv)
        assert math.isnan(value.rmv)
        assert value.excitation_frequency == 0.0
        assert value.mode == CompactionMeter.MODE_UNKNOWN
    assert all(math.isnan(item.data) for item in cmv)
    assert all(b.sequence == a.sequence + 16 for a, b in pairwise(blocks))
    assert all(block.sample_period == pytest.approx(1 / 1280) for block in blocks)
    assert all(block.phase_increment == 0.0 for block in blocks)
    assert np.abs(blocks[-1].vertical).max() < 1e-3
    static_load = (2400.0 + 3200.0) * 9.81
    assert truth[-1].soil_force[-1] == pytest.approx(static_load, rel=1e-4)
    # Ten times a second.
    times = [item.header.stamp.sec + 1e-9 * item.header.stamp.nanosec for item in states]
    assert np.median(np.diff(times)) == pytest.approx(0.1, abs=0.02)

    # And it can be started from there.
    client.command(frequency=28.0, amplitude=1.6e-3)
    client.spin_until(lambda: meter[-1].excitation_frequency > 5.0)
    assert not meter[-1].status & CompactionMeter.STANDING
    assert sim.end() == 0
