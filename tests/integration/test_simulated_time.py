# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Simulated time that goes on by itself, and real time: what a client can ask of either."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

from rosgraph_msgs.msg import Clock

from roller_sim_ros.msg import DrumAcceleration, Result, SimulationState, SimulatorFeatures
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
from tests.integration.harness import Client, recorded

STOPPED, PLAYING, PAUSED = (
    SimulationState.STATE_STOPPED,
    SimulationState.STATE_PLAYING,
    SimulationState.STATE_PAUSED,
)


def state(client: Client) -> int:
    return client.ask(GetSimulationState, "get_simulation_state").state.state


def set_state(client: Client, value: int) -> Result:
    wanted = SimulationState(state=value)
    return client.ask(SetSimulationState, "set_simulation_state", state=wanted).result


def test_simulated_time_plays_pauses_steps_and_stops(start, client):
    sim = start("--clock", "sim", "--speed", "2")
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    clock = client.listen("/clock", Clock)
    client.spin_until(lambda: len(blocks) > 50 and clock)
    assert state(client) == PLAYING
    refused = client.ask(StepSimulation, "step_simulation").result
    assert refused.result == Result.RESULT_OPERATION_FAILED
    assert "playing" in refused.error_message
    assert client.ask(Advance, "advance", revolutions=1).result.result == (
        Result.RESULT_INCORRECT_STATE
    )

    assert set_state(client, PAUSED).result == Result.RESULT_OK
    assert state(client) == PAUSED
    # What was on its way is heard; then nothing moves but by steps.
    first = client.advance(revolutions=1)
    client.spin_until(lambda: blocks[-1].sequence + len(blocks[-1].vertical) == first.next_sample)
    second = client.advance(revolutions=1)
    assert second.next_sample == first.next_sample + 128
    # Saved and restored it is paused.
    saved = client.ask(SaveState, "save_state")
    assert saved.result.result == Result.RESULT_OK
    assert set_state(client, PLAYING).result == Result.RESULT_OK
    count = len(blocks)
    client.spin_until(lambda: len(blocks) > count + 50)
    for before, after in pairwise(blocks):
        assert after.sequence == before.sequence + len(before.vertical)
    response = client.ask(RestoreState, "restore_state", state=saved.state)
    assert response.result.result == Result.RESULT_OK
    assert state(client) == PAUSED
    assert client.advance(revolutions=1).next_sample == second.next_sample + 128

    # A reset leaves it playing.
    assert set_state(client, PLAYING).result == Result.RESULT_OK
    assert client.ask(ResetSimulation, "reset_simulation").result.result == Result.RESULT_OK
    assert state(client) == PLAYING
    client.spin_until(lambda: blocks[-1].sequence < second.next_sample)
    assert set_state(client, STOPPED).result == Result.RESULT_OK
    assert state(client) == STOPPED
    assert set_state(client, PLAYING).result == Result.RESULT_OK
    client.spin_until(lambda: state(client) == PLAYING and blocks[-1].sequence > 100)
    assert sim.end() == 0
    assert sim.complaints == []


def test_scenario_as_fast_as_possible_ends_by_itself_with_a_whole_bag(start, short, tmp_path: Path):
    bag = tmp_path / "trace.mcap"
    sim = start(
        *("--scenario", str(short), "--clock", "sim", "--speed", "0", "--exit-at-end"),
        *("--record", str(bag), "--ros-args", "-p", "pacing.publish_clock:=false"),
    )
    assert sim.wait() == 0
    assert sim.complaints == []
    assert "0 dropped" in sim.said.splitlines()[-1]
    truth = recorded(bag, "/truth")
    assert [block.sequence for block in truth] == [16 * k for k in range(len(truth))]
    assert recorded(bag, "/site/state")[-1].pass_number == 2
    assert recorded(bag, "/clock") == []


def test_real_time_is_not_paused_nor_stepped_but_stops_and_starts_anew(visitor):
    features = visitor.ask(GetSimulatorFeatures, "get_simulator_features").features
    assert set(features.features) == {
        SimulatorFeatures.SIMULATION_RESET,
        SimulatorFeatures.SIMULATION_STATE_GETTING,
        SimulatorFeatures.SIMULATION_STATE_SETTING,
    }
    assert "real time" in features.custom_info
    for result, word in (
        (set_state(visitor, PAUSED), "--clock sim"),
        (visitor.ask(StepSimulation, "step_simulation").result, "--lock-step"),
        (visitor.ask(Advance, "advance", seconds=1.0).result, "--lock-step"),
        (visitor.ask(RestoreState, "restore_state", state=b"x").result, "--clock sim"),
    ):
        assert result.result == Result.RESULT_FEATURE_UNSUPPORTED
        assert word in result.error_message
    assert visitor.node.count_publishers("/clock") == 0

    blocks = visitor.listen("drum/acceleration", DrumAcceleration)
    visitor.spin_until(lambda: blocks)
    assert set_state(visitor, STOPPED).result == Result.RESULT_OK
    assert set_state(visitor, STOPPED).result == 101
    assert state(visitor) == STOPPED
    blocks.clear()
    assert set_state(visitor, PLAYING).result == Result.RESULT_OK
    visitor.spin_until(lambda: any(block.sequence == 0 for block in blocks))
    for reset in range(2):
        blocks.clear()
        assert visitor.ask(ResetSimulation, "reset_simulation").result.result == Result.RESULT_OK
        visitor.spin_until(lambda: any(block.sequence == 0 for block in blocks))
        assert blocks[-1].header.stamp.sec > 10**9, reset


def test_inactive_node_says_what_to_do(start, client):
    sim = start("--lock-step", "--ros-args", "-p", "autostart:=false")
    assert state(client) == STOPPED
    refused = set_state(client, PAUSED)
    assert refused.result == Result.RESULT_INCORRECT_STATE
    assert "activate" in refused.error_message
    assert client.ask(SaveState, "save_state").result.result == Result.RESULT_INCORRECT_STATE
    assert client.ask(Advance, "advance", revolutions=1).result.result == (
        Result.RESULT_INCORRECT_STATE
    )
    assert client.change_state("configure")
    assert client.change_state("activate")
    assert client.advance(revolutions=1).next_sample == 128
    assert client.change_state("deactivate")
    assert client.change_state("activate")
    assert client.advance(revolutions=1).next_sample == 128
    assert sim.end() == 0


def test_wrong_scenario_is_refused_in_one_line(start):
    sim = start("--scenario", "soft_to_stif")
    assert sim.wait() == 1
    assert len(sim.complaints) == 1
    assert "soft_to_stiff" in sim.complaints[0]
