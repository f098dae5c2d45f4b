# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Lock step over DDS: nothing moves by itself, steps are exact, the same samples come every time."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.msg import (
    CompactionMeter,
    DrumAcceleration,
    DrumSoilState,
    Result,
    SimulationState,
    SimulatorFeatures,
)
from roller_sim_ros.scenario import read_scenario, start_of
from roller_sim_ros.srv import (
    Advance,
    GetSimulationState,
    GetSimulatorFeatures,
    ResetSimulation,
    RestoreState,
    SaveState,
    SetSimulationState,
    StepSimulation,
)
from roller_sim_ros.wire.types import decode
from tests.integration.harness import Client, entry, recorded, roller_sim

PERIOD_NS = 1e9 / (28.0 * 128)


def nanoseconds(stamp) -> int:
    return stamp.sec * 10**9 + stamp.nanosec


def end(block) -> int:
    return block.sequence + len(block.vertical)


def state(client: Client) -> int:
    response = client.ask(GetSimulationState, "get_simulation_state")
    assert response.result.result == Result.RESULT_OK
    return response.state.state


def test_nothing_moves_until_a_client_steps(stepper):
    blocks = stepper.listen("drum/acceleration", DrumAcceleration)
    diagnostics = stepper.listen("/diagnostics", DiagnosticArray)
    stepper.spin_until(lambda: len(diagnostics) >= 2)
    assert blocks == []
    assert state(stepper) == SimulationState.STATE_PAUSED
    assert stepper.advance(revolutions=1).next_sample == 128


def test_steps_are_samples_revolutions_or_seconds(stepper):
    blocks = stepper.listen("drum/acceleration", DrumAcceleration)
    clock = stepper.listen("/clock", Clock)
    for steps in (1, 10, 16):
        response = stepper.ask(StepSimulation, "step_simulation", steps=steps)
        assert response.result.result == Result.RESULT_OK
    response = stepper.advance(revolutions=2)
    assert response.next_sample == 27 + 256
    assert nanoseconds(response.stamp) == pytest.approx(283 * PERIOD_NS, abs=1.0)
    # 0.01 s are 35.84 sample periods: rounded up.
    response = stepper.advance(seconds=0.01)
    assert response.next_sample == 27 + 256 + 36
    for _ in range(10):
        response = stepper.advance(seconds=36 * PERIOD_NS * 1e-9)
    assert response.next_sample == 27 + 256 + 11 * 36
    stepper.spin_until(lambda: blocks and end(blocks[-1]) == response.next_sample)
    assert blocks[0].sequence == 0
    for before, after in pairwise(blocks):
        assert after.sequence == end(before)
        assert end(before) % 16 == 0 or end(before) in (1, 11, 27)[:3] or before.sequence >= 27
    # The clock says up to when all is simulated, and goes before.
    stepper.spin_until(lambda: clock[-1].clock == response.stamp)


def test_clock_is_told_to_those_who_come_while_time_stands_still(stepper):
    response = stepper.advance(revolutions=3)
    with Client(stepper.node.context.get_domain_id()) as late:
        late.node.set_parameters([Parameter("use_sim_time", value=True)])
        stamp = nanoseconds(response.stamp)
        late.spin_until(lambda: late.node.get_clock().now().nanoseconds == stamp)


def test_same_scenario_gives_the_same_bytes_as_without_ros(stepper, scenario: Path):
    heard = stepper.listen("drum/acceleration", DrumAcceleration)
    meter = stepper.listen("meter", CompactionMeter)

    def is_heard() -> bool:
        # Until the roller has found the subscriptions it sends nothing to them.
        last = stepper.advance(revolutions=1).next_sample - 1
        return bool(heard) and bool(meter) and meter[-1].last_sample == last

    stepper.spin_until(is_heard)
    assert stepper.ask(ResetSimulation, "reset_simulation").result.result == Result.RESULT_OK
    stepper.spin_for(0.5)
    heard.clear()
    meter.clear()
    stepper.advance(revolutions=40)
    emulator = Emulator(start_ns=0, **start_of(read_scenario(scenario))._asdict())
    expected = [message for _ in range(40 * 8) for message in emulator.advance(16)]
    blocks = [decode(it.data, it.type_name) for it in expected if it.topic == "drum/acceleration"]
    values = [decode(it.data, it.type_name).cmv for it in expected if it.topic == "meter"]
    stepper.spin_until(lambda: len(heard) >= len(blocks) and len(meter) >= len(values))
    assert len(blocks) == len(heard)
    for own, block in zip(blocks, heard, strict=True):
        assert own.vertical.tobytes() == block.vertical.tobytes()
        assert nanoseconds(own.header.stamp) == nanoseconds(block.header.stamp)
    for own, value in zip(values, meter, strict=True):
        assert own == value.cmv or (math.isnan(own) and math.isnan(value.cmv))


def test_reset_begins_anew(stepper):
    blocks = stepper.listen("drum/acceleration", DrumAcceleration)
    clock = stepper.listen("/clock", Clock)
    assert stepper.set_parameter("exciter.amplitude_m", 0.5e-3).successful
    response = stepper.advance(revolutions=2)
    stepper.spin_until(lambda: blocks and clock and clock[-1].clock == response.stamp)
    assert stepper.ask(ResetSimulation, "reset_simulation").result.result == Result.RESULT_OK
    stepper.spin_until(lambda: nanoseconds(clock[-1].clock) == 0)
    blocks.clear()
    stepper.advance(revolutions=1)
    stepper.spin_until(lambda: blocks)
    assert blocks[0].sequence == 0
    assert nanoseconds(blocks[0].header.stamp) == 0
    # Parameters are those of the start again.
    stepper.spin_until(lambda: stepper.get_parameter("exciter.amplitude_m") == 1.4e-3)


def test_restored_run_goes_on_with_the_same_bits(stepper, tmp_path: Path):
    blocks = stepper.listen("drum/acceleration", DrumAcceleration)
    stepper.advance(revolutions=5)
    stepper.ask(StepSimulation, "step_simulation", steps=40)
    saved = stepper.ask(SaveState, "save_state")
    assert saved.result.result == Result.RESULT_OK
    path = str(tmp_path / "state")
    written = stepper.ask(SaveState, "save_state", path=path)
    assert written.result.result == Result.RESULT_OK
    assert len(written.state) == 0
    assert Path(path).read_bytes() == bytes(saved.state)
    truth = stepper.listen("truth", DrumSoilState)
    runs = []
    for fields in ({}, {"state": saved.state}, {"path": path}):
        if fields:
            response = stepper.ask(RestoreState, "restore_state", **fields)
            assert response.result.result == Result.RESULT_OK, response.result.error_message
        blocks.clear()
        truth.clear()
        response = stepper.advance(revolutions=4)
        assert response.next_sample == 9 * 128 + 40
        # What a sensor delivers comes later than the truth, from what was sampled before, too.
        stepper.spin_until(lambda: truth and end(truth[-1]) == 9 * 128 + 40)
        stepper.spin_until(lambda: blocks and end(blocks[-1]) >= 9 * 128)
        runs.append(
            [
                (block.sequence, nanoseconds(block.header.stamp), block.vertical.tobytes())
                for block in (*truth, *blocks)
                if block.sequence >= 5 * 128 + 40 and end(block) <= 9 * 128
            ]
        )
    assert len(runs[0]) > 50
    assert runs[0] == runs[1] == runs[2]


REFUSED = {
    "no step": (StepSimulation, "step_simulation", {"steps": 0}, 4, ["steps 0", "1 …"]),
    "steps without end": (StepSimulation, "step_simulation", {"steps": 2**63}, 4, ["at a time"]),
    "neither": (Advance, "advance", {}, 4, ["one of them must be 0"]),
    "both": (Advance, "advance", {"revolutions": 1, "seconds": 1.0}, 4, ["one of them must be 0"]),
    "time that is none": (Advance, "advance", {"seconds": math.nan}, 4, ["seconds nan", "3600 s"]),
    "time without end": (Advance, "advance", {"seconds": math.inf}, 4, ["seconds inf", "3600 s"]),
    "back": (Advance, "advance", {"seconds": -1.0}, 4, ["seconds -1", "3600 s"]),
    "too long": (Advance, "advance", {"revolutions": 10**9}, 4, ["1000000000", "at most"]),
    "time alone": (ResetSimulation, "reset_simulation", {"scope": 1}, 0, ["scope 1", "together"]),
    "spawned": (ResetSimulation, "reset_simulation", {"scope": 4}, 0, ["scope 4"]),
    "no state": (RestoreState, "restore_state", {"state": b"rubbish"}, 4, ["saved state"]),
    "empty": (RestoreState, "restore_state", {}, 4, ["saved state"]),
    "no file": (RestoreState, "restore_state", {"path": "/nowhere/x"}, 2, ["/nowhere/x"]),
    "not both": (RestoreState, "restore_state", {"path": "x", "state": b"x"}, 4, ["path and"]),
    "there already": (SaveState, "save_state", {"path": "/etc/passwd"}, 4, ["/etc/passwd"]),
    "no folder": (SaveState, "save_state", {"path": "/nowhere/x"}, 4, ["No such file"]),
    "playing": (
        SetSimulationState,
        "set_simulation_state",
        {"state": SimulationState(state=SimulationState.STATE_PLAYING)},
        0,
        ["lock step", "advance"],
    ),
    "paused already": (
        SetSimulationState,
        "set_simulation_state",
        {"state": SimulationState(state=SimulationState.STATE_PAUSED)},
        101,
        ["paused already"],
    ),
    "no such state": (
        SetSimulationState,
        "set_simulation_state",
        {"state": SimulationState(state=77)},
        0,
        ["state 77"],
    ),
}


@pytest.mark.parametrize(
    ("service", "name", "fields", "result", "words"), REFUSED.values(), ids=REFUSED
)
def test_refused_request_says_why_and_changes_nothing(
    stepper, service, name, fields, result, words
):
    response = stepper.ask(service, name, **fields)
    assert response.result.result == result
    for word in words:
        assert word in response.result.error_message
    assert stepper.advance(revolutions=1).next_sample == 128


def test_stopped_is_reset_and_starts_paused(stepper):
    def set_state(value: int) -> int:
        wanted = SimulationState(state=value)
        return stepper.ask(SetSimulationState, "set_simulation_state", state=wanted).result.result

    stepper.advance(revolutions=1)
    assert set_state(SimulationState.STATE_STOPPED) == Result.RESULT_OK
    assert state(stepper) == SimulationState.STATE_STOPPED
    refused = stepper.ask(Advance, "advance", revolutions=1)
    assert refused.result.result == Result.RESULT_INCORRECT_STATE
    refused = stepper.ask(StepSimulation, "step_simulation")
    assert refused.result.result == Result.RESULT_OPERATION_FAILED
    refused = stepper.ask(SaveState, "save_state")
    assert refused.result.result == Result.RESULT_INCORRECT_STATE
    assert set_state(SimulationState.STATE_PAUSED) == Result.RESULT_OK
    assert stepper.advance(revolutions=1).next_sample == 128


def test_features_are_those_of_lock_step(stepper):
    features = stepper.ask(GetSimulatorFeatures, "get_simulator_features").features
    assert set(features.features) == {
        SimulatorFeatures.SIMULATION_RESET,
        SimulatorFeatures.SIMULATION_STATE_GETTING,
        SimulatorFeatures.SIMULATION_STATE_SETTING,
        SimulatorFeatures.SIMULATION_STATE_PAUSE,
        SimulatorFeatures.STEP_SIMULATION_SINGLE,
        SimulatorFeatures.STEP_SIMULATION_MULTIPLE,
    }
    assert "lock step" in features.custom_info


def test_recording_drops_nothing_and_every_run_has_its_own(start, client, short, tmp_path: Path):
    bag = tmp_path / "trace.mcap"
    sim = start("--lock-step", "--scenario", str(short), "--record", str(bag))
    client.advance(revolutions=90)
    response = client.advance(seconds=1.0)
    assert client.ask(ResetSimulation, "reset_simulation").result.result == Result.RESULT_OK
    client.advance(revolutions=1)
    assert sim.end() == 0
    (told,) = sim.complaints
    assert "the scenario has been driven" in told
    assert "0 dropped" in sim.said.splitlines()[-1]
    truth = recorded(bag, "/truth")
    assert [block.sequence for block in truth] == [16 * k for k in range(len(truth))]
    assert end(truth[-1]) == response.next_sample
    # Recorded when it was sent, in simulated time.
    clock = recorded(bag, "/clock")
    assert len(clock) == len(truth)
    assert clock[-1].clock.sec == response.stamp.sec
    assert [block.sequence for block in recorded(tmp_path / "trace-2.mcap", "/truth")] == [
        16 * k for k in range(8)
    ]


def test_quitting_ends_the_process(start, client, tmp_path: Path):
    bag = tmp_path / "trace.mcap"
    sim = start("--lock-step", "--record", str(bag))
    client.advance(revolutions=2)
    wanted = SimulationState(state=SimulationState.STATE_QUITTING)
    response = client.ask(SetSimulationState, "set_simulation_state", state=wanted)
    assert response.result.result == Result.RESULT_OK
    assert sim.wait() == 0
    assert end(recorded(bag, "/truth")[-1]) == 256


def test_signal_cuts_a_long_step_short(start, client, tmp_path: Path):
    bag = tmp_path / "trace.mcap"
    sim = start("--lock-step", "--record", str(bag))
    blocks = client.listen("truth", DrumSoilState)
    service = client.node.create_client(Advance, "advance")
    client.spin_until(service.service_is_ready)
    service.call_async(Advance.Request(seconds=3600.0))
    client.spin_until(lambda: len(blocks) > 100)
    assert sim.end() == 0
    assert "0 dropped" in sim.said.splitlines()[-1]
    in_bag = recorded(bag, "/truth")
    assert len(in_bag) >= len(blocks)
    assert [block.sequence for block in in_bag] == [16 * k for k in range(len(in_bag))]


def test_exit_at_end_stops_with_the_sample_at_which_all_is_driven(start, client, short):
    sim = start("--lock-step", "--exit-at-end", "--scenario", str(short))
    response = client.advance(seconds=60.0)
    assert sim.wait() == 0
    driven = json.loads(roller_sim("run", short, "--json", "-"))
    assert nanoseconds(response.stamp) == pytest.approx(driven["duration_s"] * 1e9, abs=1.0)
    assert sim.complaints == []


def test_two_owners_of_the_clock_are_told(stepper, stepped_sim):
    diagnostics = stepper.listen("/diagnostics", DiagnosticArray)
    stepper.spin_until(lambda: (found := entry(diagnostics, "clock")) and found.level == b"\x00")
    other = stepper.node.create_publisher(Clock, "/clock", 1)
    name = stepper.node.get_fully_qualified_name()
    found = stepper.spin_until(
        lambda: (found := entry(diagnostics, "clock")) and found.level == b"\x01" and found
    )
    assert name in found.message
    assert "pacing.publish_clock" in found.message
    assert sum(name in line for line in stepped_sim[1].complaints) == 1
    stepper.node.destroy_publisher(other)
    stepper.spin_until(lambda: entry(diagnostics, "clock").level == b"\x00")
