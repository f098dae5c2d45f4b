# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""One master at a time: the scenario, or a live command until it is released."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.parameters import Configuration, ParameterError
from roller_sim_ros.scenario import Scenario, parse_scenario, start_of
from roller_sim_ros.session import Applied, Block, CommandRefused, Master, Refusal, Session
from roller_sim_ros.wire.types import decode

TEXT = """
lane: {length_m: 6, cell_m: 0.5}
travel: {passes: 2}
ground:
  shear_modulus_mpa: 30
  features: [{kind: random_field, coefficient_of_variation: 0.2, correlation_length_m: 1}]
  compaction: {kind: exponential, limit_shear_modulus_mpa: 60}
exciter:
  amplitude_mm: 1.6
  programme:
    - {from_m: 1, to_m: 2, amplitude_mm: 1.2}
    - {from_pass: 2, frequency_hz: 30}
seed: 3
"""
SCENARIO = parse_scenario(TEXT, Path("masters.yaml"))


def session(scenario: Scenario = SCENARIO) -> Session:
    return start_of(scenario).session()


def advance(roller: Session, revolutions: int) -> Block:
    for _ in range(revolutions):
        block = roller.advance(128)
    return block


def of_master(applied: list[Applied]) -> list[tuple[int, str, object, str]]:
    return [(it.sample // 128, it.name, it.value, it.master.label) for it in applied]


def test_the_session_obeys_the_programme_at_multiples_of_128_samples() -> None:
    roller = session()
    advance(roller, 29)
    assert roller.applied() == []
    advance(roller, 1)
    # Beyond one metre, 28 revolutions and what rounding leaves of it.
    assert of_master(roller.applied()) == [(29, "exciter.amplitude_m", 1.2e-3, "scenario")]
    assert roller.exciter_status().master is Master.SCENARIO
    advance(roller, 28)
    assert of_master(roller.applied()) == [(56, "exciter.amplitude_m", 1.6e-3, "scenario")]
    while roller.site.position.pass_number == 1:
        advance(roller, 1)
    advance(roller, 1)
    ((at, name, value, _),) = of_master(roller.applied())
    assert (at, name, value) == (169, "exciter.frequency_hz", 30.0)


def test_a_live_command_overrides_the_programme_until_it_is_released() -> None:
    roller = session()
    advance(roller, 20)
    roller.advance(64)
    roller.command_exciter(vibrate=True, frequency_hz=28.0, amplitude_m=1.0e-3)
    roller.advance(64)
    assert roller.applied() == []
    advance(roller, 20)
    assert of_master(roller.applied()) == [
        (21, "exciter.master", "command", "command"),
        (21, "exciter.amplitude_m", 1.0e-3, "command"),
    ]
    # The programme's step at one metre does nothing.
    assert roller.exciter_status().amplitude_m == 1.0e-3
    assert roller.exciter_status().master is Master.COMMAND
    assert roller.masters.travel is Master.SCENARIO
    assert roller.site.position.chainage_m > 1.0
    roller.release()
    advance(roller, 5)
    assert of_master(roller.applied()) == [
        (41, "exciter.master", "scenario", "scenario"),
        (41, "exciter.amplitude_m", 1.2e-3, "scenario"),
    ]
    assert roller.exciter_status().master is Master.SCENARIO


def test_a_parameter_of_the_exciter_changed_live_is_a_command_too() -> None:
    roller = session()
    advance(roller, 2)
    roller.change({"exciter.amplitude_m": 1.0e-3, "exciter.frequency_rate_hz_per_s": 5.0})
    advance(roller, 40)
    assert of_master(roller.applied()) == [
        (2, "exciter.master", "command", "command"),
        (2, "exciter.amplitude_m", 1.0e-3, "command"),
        (2, "exciter.frequency_rate_hz_per_s", 5.0, "none"),
    ]
    roller.change({"exciter.amplitude_rate_m_per_s": 1e-3})
    roller.release()
    advance(roller, 1)
    assert roller.exciter_status().master is Master.SCENARIO


def test_the_last_of_command_and_release_counts() -> None:
    roller = session()
    roller.command_exciter(vibrate=True, frequency_hz=25.0, amplitude_m=1e-3)
    roller.command_travel(2.0)
    roller.release()
    advance(roller, 1)
    assert roller.applied() == []
    assert roller.exciter_status().commanded_frequency_hz == 28.0
    roller.release()
    roller.command_exciter(vibrate=True, frequency_hz=28.0, amplitude_m=1.6e-3)
    advance(roller, 1)
    assert of_master(roller.applied()) == [(1, "exciter.master", "command", "command")]


def test_a_travel_command_overrides_the_plan_until_it_is_released() -> None:
    roller = session()
    advance(roller, 28)
    roller.command_travel(-0.5)
    roller.command_travel(-2.0)
    advance(roller, 17)
    assert of_master(roller.applied())[:2] == [
        (28, "travel.master", "cmd_vel", "cmd_vel"),
        (28, "travel.speed_m_s", -2.0, "cmd_vel"),
    ]
    assert roller.site.position.chainage_m == pytest.approx(0.0)
    assert roller.site.position.pass_number == 2
    assert roller.masters.exciter is Master.SCENARIO
    # The same again is nothing new.
    roller.command_travel(-2.0)
    advance(roller, 1)
    assert "travel.speed_m_s" not in [it.name for it in roller.applied()]
    roller.command_travel(1.0)
    advance(roller, 28)
    roller.release()
    advance(roller, 14)
    # Beyond the planned number of passes: it stands, and the exciter stops.
    assert of_master(roller.applied())[-2:] == [
        (74, "travel.master", "scenario", "scenario"),
        (74, "exciter.vibrate", False, "scenario"),
    ]
    assert roller.site.position.finished
    assert not roller.exciter_status().vibrating


@pytest.mark.parametrize(
    ("speed", "code", "reason"),
    [
        (math.nan, Refusal.NOT_FINITE, "speed nan m/s: must be finite"),
        (math.inf, Refusal.NOT_FINITE, "speed inf m/s: must be finite"),
        (-5.1, Refusal.OUT_OF_RANGE, "speed -5.1 m/s: must be at most 5 m/s forth or back"),
    ],
)
def test_bad_speeds_are_refused_and_the_roller_carries_on(
    speed: float, code: Refusal, reason: str
) -> None:
    roller = session()
    with pytest.raises(CommandRefused) as caught:
        roller.command_travel(speed)
    assert (caught.value.code, str(caught.value)) == (code, reason)
    advance(roller, 2)
    assert roller.applied() == []
    assert roller.masters.travel is Master.SCENARIO


def test_without_a_scenario_there_are_no_masters() -> None:
    roller = Session(Configuration())
    roller.command_exciter(vibrate=True, frequency_hz=30.0, amplitude_m=1.6e-3)
    roller.command_travel(1.0)
    advance(roller, 28)
    assert of_master(roller.applied()) == [
        (0, "travel.speed_m_s", 1.0, "none"),
        (0, "exciter.frequency_hz", 30.0, "none"),
    ]
    assert roller.exciter_status().master is Master.NONE
    there = roller.site.position.chainage_m
    assert there > 0.8
    roller.release()
    advance(roller, 3)
    assert of_master(roller.applied()) == [(28, "travel.speed_m_s", 0.0, "none")]
    assert roller.exciter_status().commanded_frequency_hz == 30.0
    assert roller.site.position.chainage_m == pytest.approx(there, abs=0.05)


def test_what_the_lane_decides_cannot_be_changed() -> None:
    roller = session()
    with pytest.raises(ParameterError, match="soil.shear_modulus_pa.*the scenario's ground"):
        roller.change({"soil.shear_modulus_pa": 80e6})
    advance(roller, 1)
    assert roller.applied() == []


def test_the_same_samples_come_whatever_the_blocks() -> None:
    whole, pieces = session(), session()
    for roller in (whole, pieces):
        roller.command_travel(2.5)
    for revolution in range(120):
        expected = whole.advance(128)
        blocks = [pieces.advance(size) for size in (16, 100, 12)]
        if revolution == 60:
            for roller in (whole, pieces):
                roller.release()
        for name in ("acceleration_vertical", "soil_force", "drum_height"):
            found = np.concatenate([getattr(block, name) for block in blocks])
            assert np.array_equal(found, getattr(expected, name))
        assert {block.shear_modulus_pa for block in blocks} == {expected.shear_modulus_pa}
    assert whole.applied() == pieces.applied()


def test_the_emulator_tells_who_is_master_and_takes_travel_commands() -> None:
    emulator = Emulator(start_ns=0, **start_of(SCENARIO)._asdict())
    sites, states, applied = [], [], []
    for revolution in range(60):
        if revolution == 10:
            emulator.command(vibrate=True, frequency_hz=28.0, amplitude_m=1.0e-3)
        if revolution == 20:
            emulator.command_travel(2.0)
        if revolution == 40:
            emulator.release()
        for message in emulator.advance(128):
            content = decode(message.data, message.type_name)
            if message.topic == "site/state":
                sites.append(content)
            elif message.topic == "exciter/state":
                states.append(content)
            elif message.topic == "applied":
                applied.append(content)
    assert [it.last_sample for it in sites] == [128 * n + 127 for n in range(60)]
    assert [(it.exciter_master, it.travel_master) for it in sites] == (
        [(1, 1)] * 10 + [(2, 1)] * 10 + [(2, 3)] * 20 + [(1, 1)] * 20
    )
    assert {it.master for it in states} == {1, 2}
    assert [(it.name, it.text) for it in applied if it.name.endswith("master")] == [
        ("exciter.master", "command"),
        ("travel.master", "cmd_vel"),
        ("exciter.master", "scenario"),
        ("travel.master", "scenario"),
    ]
    assert sites[5].chainage == pytest.approx(5 / 28)
    assert sites[30].speed == 2.0
    assert len({it.shear_modulus for it in sites}) > 3
    assert math.isnan(sites[3].cmv)
    assert sites[59].cmv > 10.0
