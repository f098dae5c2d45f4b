# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What is in the bag beside the node's own topics: commands, parameter events, the meter under test."""

from __future__ import annotations

import math

import numpy as np
import pytest
from action_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PointStamped
from rcl_interfaces.msg import ParameterEvent
from std_msgs.msg import Float64

from roller_sim_ros import __version__
from roller_sim_ros.msg import (
    AppliedChange,
    CompactionMeter,
    DrumSoilState,
    ExciterState,
    Result,
)
from roller_sim_ros.offline.replay import replay
from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.srv import ResetSimulation
from roller_sim_ros.traces.metadata import PARAMETERS as PARAMETER_RECORD
from roller_sim_ros.traces.metadata import RUN
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.wire.topics import TOPICS
from tests.integration.harness import entry, recorded, values


def changed_parameters(events) -> dict[str, float]:
    """Return what the roller's events say of numbers that were set, the last value of each."""
    return {
        item.name: item.value.double_value
        for event in events
        if event.node == "/roller_sim"
        for item in event.changed_parameters
    }


def test_bag_holds_all_that_belongs_to_the_run(start, client, tmp_path):
    bag = tmp_path / "trace.mcap"
    sim = start(
        *("--record", str(bag), "--shear-modulus-mpa", "60"),
        *("--record-topic", "my_meter/cmv", "--record-topic", "/place"),
        *("--record-topic", "nobody", "--record-topic", "cmv"),
    )
    states = client.listen("exciter/state", ExciterState)
    applied = client.listen("applied", AppliedChange)
    diagnostics = client.listen("/diagnostics", DiagnosticArray)
    events = client.listen("/parameter_events", ParameterEvent)
    client.spin_until(lambda: states)

    # Topics of others appear while the roller runs.
    meter = client.node.create_publisher(Float64, "my_meter/cmv", 10)
    place = client.node.create_publisher(PointStamped, "/place", 10)
    client.spin_until(meter.get_subscription_count)
    client.spin_until(place.get_subscription_count)
    for number in range(20):
        meter.publish(Float64(data=float(number)))
    point = PointStamped()
    point.header.frame_id = "site"
    point.point.x = 4.5
    place.publish(point)

    # Commands, accepted and refused, and parameters.
    client.command(frequency=29.0, amplitude=1e-3)
    client.command(frequency=math.nan, amplitude=1e-3)
    client.spin_until(lambda: states[-1].refusal_code)
    assert client.set_parameter("soil.shear_modulus_pa", 70e6).successful
    client.spin_until(lambda: any(item.value == 70e6 for item in applied))
    client.spin_until(
        lambda: (
            (found := entry(diagnostics, "recording"))
            and found.level == DiagnosticStatus.WARN
            and found.message == "nobody publishes /nobody yet"
        )
    )
    # The command shows as a parameter within a second.
    client.spin_until(lambda: changed_parameters(events).get("exciter.frequency_hz") == 29.0)
    client.spin_for(0.5)
    assert sim.end() == 0

    reader = TraceReader(bag)
    assert reader.whole
    names = {topic.resolved() for topic in TOPICS if not topic.of_simulated_time}
    assert names | {"/my_meter/cmv", "/place"} <= reader.topics.keys()
    for name in ("/my_meter/cmv", "/place"):
        assert reader.topics[name].messages > 0
    assert [item.data for item in recorded(bag, "/my_meter/cmv")] == [float(n) for n in range(20)]
    (there,) = recorded(bag, "/place")
    assert there.point.x == 4.5
    assert there.header.frame_id == "site"

    commands = recorded(bag, "/exciter/command")
    assert commands[0].frequency == 29.0
    assert math.isnan(commands[1].frequency)
    changed = changed_parameters(recorded(bag, "/parameter_events"))
    assert changed["soil.shear_modulus_pa"] == 70e6
    assert changed["exciter.frequency_hz"] == 29.0

    run, parameters = reader.metadata[RUN], reader.metadata[PARAMETER_RECORD]
    assert run["version"] == __version__
    assert int(run["start_time_ns"]) > 0
    assert parameters["soil.shear_modulus_pa"] == "60000000.0"
    assert parameters["recording.path"] == str(bag)

    # Times of publishing and receiving make sense.
    for message in reader.messages():
        assert 0 <= message.log_time_ns - message.publish_time_ns < 10**9, message.topic
    first = next(iter(reader.messages(["/drum/acceleration"])))
    stamp = recorded(bag, "/drum/acceleration")[0].header.stamp
    assert 0 <= first.log_time_ns - (stamp.sec * 10**9 + stamp.nanosec) < 10**9


def test_acceleration_by_the_sample_is_recorded_when_asked_for(start, client, tmp_path):
    bag = tmp_path / "trace.mcap"
    sim = start(
        "--record",
        str(bag),
        "--record-topic",
        "drum/imu",
        "--ros-args",
        "-p",
        "pacing.imu_decimation:=4",
    )
    meters = client.listen("meter", CompactionMeter)
    client.spin_until(lambda: len(meters) > 3)
    assert sim.end() == 0
    blocks = recorded(bag, "/drum/acceleration")
    samples = recorded(bag, "/drum/imu")
    vertical = np.concatenate([block.vertical for block in blocks])
    assert len(samples) > 3 * 128 / 4
    found = [sample.linear_acceleration.z for sample in samples]
    assert found == pytest.approx(vertical[::4][: len(found)] + GRAVITY_M_S2, rel=1e-6)


def test_recordings_begin_and_end_while_the_roller_goes_on(start, client, tmp_path):
    sim = start("--shear-modulus-mpa", "60")
    blocks = client.listen("truth", DrumSoilState)
    diagnostics = client.listen("/diagnostics", DiagnosticArray)
    client.spin_until(lambda: len(blocks) > 400)
    client.command(frequency=27.0, amplitude=1.2e-3)
    assert client.set_parameter("soil.shear_modulus_pa", 70e6).successful
    bags = [tmp_path / f"{name}.mcap" for name in ("first", "second")]
    for bag in bags:
        assert client.set_parameter("recording.path", str(bag)).successful
        assert client.get_parameter("recording.path") == str(bag)
        came = len(blocks)
        client.spin_until(lambda came=came: len(blocks) > came + 300)
        refused = client.set_parameter("recording.flush_period_s", 0.2)
        assert f"cannot change while {bag} is recorded to" in refused.reason
    refused = client.set_parameter("recording.path", str(bags[0]))
    assert "there already is such a file" in refused.reason
    client.spin_until(
        lambda: (found := entry(diagnostics, "recording")) and values(found)["path"] == str(bags[1])
    )
    assert client.set_parameter("recording.path", "").successful
    client.spin_until(
        lambda: (
            (found := entry(diagnostics, "recording")) and found.message == "nothing is recorded"
        )
    )
    assert sim.end() == 0
    sequences = [block.sequence for block in blocks]
    assert sequences == list(range(sequences[0], sequences[-1] + 1, 16))

    follows = 0
    for bag in bags:
        reader = TraceReader(bag)
        assert reader.whole
        truth = recorded(bag, "/truth")
        assert truth[0].sequence >= max(follows, 400 * 16 - 128)
        assert len(truth) >= 290
        follows = truth[-1].sequence + 16
        for name in ("/machine", "/soil", "/faults", "/exciter/state"):
            assert reader.topics[name].messages > 0
        assert reader.metadata[PARAMETER_RECORD]["soil.shear_modulus_pa"] == "70000000.0"
        (run,) = (found := replay(bag)).runs
        assert found.difference is None
        assert run.first_sample == truth[0].sequence
        assert run.lost == 0


def test_in_lock_step_a_recording_begins_between_two_steps(start, client, tmp_path):
    sim = start("--lock-step")
    client.advance(revolutions=3)
    bag = tmp_path / "trace.mcap"
    assert client.set_parameter("recording.path", str(bag)).successful
    client.advance(revolutions=2)
    assert client.ask(ResetSimulation, "reset_simulation").result.result == Result.RESULT_OK
    client.advance(revolutions=1)
    assert sim.end() == 0
    for name, begins, samples in (("trace", 3 * 128, 2 * 128), ("trace-2", 0, 128)):
        (run,) = (found := replay(bag.with_stem(name))).runs
        assert found.difference is None
        assert (run.first_sample, run.samples) == (begins, samples)


def test_type_without_definition_is_reported_not_fatal(start, client, tmp_path):
    bag = tmp_path / "trace.mcap"
    # The roller finds an empty package where its messages should be.
    (tmp_path / "empty" / "action_msgs").mkdir(parents=True)
    (tmp_path / "empty" / "action_msgs" / "__init__.py").touch()
    sim = start(
        *("--record", str(bag), "--record-topic", "/odd"), PYTHONPATH=str(tmp_path / "empty")
    )
    diagnostics = client.listen("/diagnostics", DiagnosticArray)
    client.node.create_publisher(GoalStatus, "/odd", 10)
    status = client.spin_until(
        lambda: (
            (found := entry(diagnostics, "recording"))
            and found.level == DiagnosticStatus.ERROR
            and found
        )
    )
    assert "/odd" in status.message
    assert sim.end() == 0
    assert len(sim.complaints) == 1
