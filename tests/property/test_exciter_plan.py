# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What holds for every plan of revolutions, whatever is commanded when, at any rates and any floor."""

from __future__ import annotations

import itertools
import math

from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.exciter import ExciterDrive, Revolution
from roller_sim_ros.parameters import Exciter

TURN = 2.0 * math.pi
SAMPLES = 128

FLOORS = st.one_of(st.just(10.0), st.floats(1.0, 80.0))
FREQUENCY_RATES = st.one_of(st.just(10.0), st.floats(0.5, 1000.0))
AMPLITUDE_RATES = st.one_of(st.just(2e-3), st.floats(1e-5, 1.0))
FREQUENCIES = st.one_of(st.just(0.0), st.floats(0.0, 80.0))
AMPLITUDES = st.floats(0.0, 5e-3)
COMMANDS = st.lists(st.tuples(st.integers(1, 60), FREQUENCIES, AMPLITUDES), min_size=1, max_size=6)
"""(revolutions until the next command, frequency, amplitude)."""


@st.composite
def drives(draw: st.DrawFn) -> tuple[ExciterDrive, float]:
    floor_hz = draw(FLOORS)
    exciter = Exciter(
        frequency_hz=draw(FREQUENCIES),
        amplitude_m=draw(AMPLITUDES),
        frequency_rate_hz_per_s=draw(FREQUENCY_RATES),
        amplitude_rate_m_per_s=draw(AMPLITUDE_RATES),
    )
    return ExciterDrive(exciter, floor_hz, run_up=draw(st.booleans())), floor_hz


def follow(drive: ExciterDrive, commands: list[tuple[int, float, float]]) -> list[Revolution]:
    plans = []
    for revolutions, frequency_hz, amplitude_m in commands:
        drive.target_frequency_hz, drive.target_amplitude_m = frequency_hz, amplitude_m
        plans += [drive.next_revolution() for _ in range(revolutions)]
    return plans


@given(drives(), COMMANDS)
@settings(max_examples=400, deadline=None)
def test_at_and_above_the_floor_a_revolution_is_128_samples_from_phase_zero(
    given_drive: tuple[ExciterDrive, float], commands: list[tuple[int, float, float]]
) -> None:
    drive, floor_hz = given_drive
    for plan in follow(drive, commands):
        if plan.frequency_hz >= floor_hz:
            assert plan.phase_rad == 0.0
            assert plan.phase_increment_rad == TURN / SAMPLES
            assert plan.sample_period_s == 1.0 / (SAMPLES * plan.frequency_hz)
        else:
            assert plan.sample_period_s == 1.0 / (SAMPLES * floor_hz)
            assert plan.phase_increment_rad < TURN / SAMPLES
        assert 0.0 <= plan.phase_rad < TURN
        assert math.isclose(plan.omega, TURN * plan.frequency_hz, rel_tol=1e-12, abs_tol=1e-12)


@given(drives(), COMMANDS)
@settings(max_examples=400, deadline=None)
def test_frequency_and_amplitude_keep_their_rate_limits(
    given_drive: tuple[ExciterDrive, float], commands: list[tuple[int, float, float]]
) -> None:
    drive, floor_hz = given_drive
    frequency_hz, amplitude_m = drive.frequency_hz, drive.amplitude_m
    for plan in follow(drive, commands):
        # A revolution takes over what the one before it had the time for.
        elapsed_s = 1.0 / max(frequency_hz, floor_hz)
        most_hz = drive.frequency_rate_hz_per_s * elapsed_s
        most_m = drive.amplitude_rate_m_per_s * elapsed_s
        assert abs(plan.frequency_hz - frequency_hz) <= most_hz * (1.0 + 1e-9) + 1e-12
        assert abs(plan.amplitude_m - amplitude_m) <= most_m * (1.0 + 1e-9) + 1e-15
        assert plan.changing == (
            (plan.frequency_hz, plan.amplitude_m) != (frequency_hz, amplitude_m)
        )
        frequency_hz, amplitude_m = plan.frequency_hz, plan.amplitude_m


@given(drives(), COMMANDS)
@settings(max_examples=400, deadline=None)
def test_the_force_goes_on_where_the_revolution_before_ended(
    given_drive: tuple[ExciterDrive, float], commands: list[tuple[int, float, float]]
) -> None:
    drive, _ = given_drive
    plans = follow(drive, commands)
    for before, after in itertools.pairwise(plans):
        end = before.phase_rad + SAMPLES * before.phase_increment_rad
        size = before.end_acceleration
        for component in (math.sin, math.cos):
            ended = size * component(end)
            begun = after.start_acceleration * component(after.phase_rad)
            assert abs(begun - ended) <= 1e-8 * size


@given(drives(), FREQUENCIES, AMPLITUDES, COMMANDS)
@settings(max_examples=200, deadline=None)
def test_every_command_is_reached(
    given_drive: tuple[ExciterDrive, float],
    frequency_hz: float,
    amplitude_m: float,
    commands: list[tuple[int, float, float]],
) -> None:
    drive, floor_hz = given_drive
    follow(drive, commands)
    # At the full rate; twice the way round the phase where the floor is met out of step, at one step of the rate
    # limit of slip each.
    ramp_s = 160.0 / drive.frequency_rate_hz_per_s + 5e-3 / drive.amplitude_rate_m_per_s
    slip_s = 4.0 * floor_hz / drive.frequency_rate_hz_per_s
    limit_s = 2.0 * (ramp_s + slip_s) + 20.0 / floor_hz
    drive.target_frequency_hz, drive.target_amplitude_m = frequency_hz, amplitude_m
    elapsed_s = 0.0
    while (drive.frequency_hz, drive.amplitude_m) != (frequency_hz, amplitude_m):
        elapsed_s += SAMPLES * drive.next_revolution().sample_period_s
        assert elapsed_s < limit_s
