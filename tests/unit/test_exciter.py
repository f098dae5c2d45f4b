# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The exciter: force integrals, directions, the plan of revolutions."""

from __future__ import annotations

import math

import pytest
from scipy.integrate import quad

from roller_sim_ros.exciter import DIRECTIONS, ExciterDrive, Revolution, exciter_motion
from roller_sim_ros.parameters import Exciter

TURN = 2.0 * math.pi
FLOOR_HZ = 10.0


def drive(*, run_up: bool = False, samples: int = 128, **exciter: float) -> ExciterDrive:
    return ExciterDrive(Exciter(**exciter), FLOOR_HZ, run_up=run_up, samples=samples)  # type: ignore[arg-type]


def plans(exciter: ExciterDrive, count: int) -> list[Revolution]:
    return [exciter.next_revolution() for _ in range(count)]


@pytest.mark.parametrize(
    ("samples", "error"), [(32, 3e-11), (64, 1e-12), (128, 1e-12), (512, 1e-12)]
)
@pytest.mark.parametrize("phase", [0.0, 0.7, 2.0, 4.4, 6.2])
@pytest.mark.parametrize("part", [1.0, 0.37, 1e-3])
@pytest.mark.parametrize(("amplitude", "rate"), [(50.0, 0.0), (50.0, -3e3), (0.0, 2e4)])
def test_force_integrals_are_those_of_quadrature(
    samples: int, error: float, phase: float, part: float, amplitude: float, rate: float
) -> None:
    omega = TURN * 28.0
    step = part * TURN / (omega * samples)

    def acceleration(time: float) -> float:
        return (amplitude + rate * time) * math.sin(phase + omega * time)

    def weighted(time: float) -> float:
        return (step - time) * acceleration(time)

    velocity, travel = exciter_motion(
        step, omega, math.sin(phase), math.cos(phase), amplitude, rate
    )
    size = abs(amplitude) + abs(rate) * step
    precise = {"epsabs": 0.0, "epsrel": 1e-13, "limit": 200}
    assert velocity == pytest.approx(
        quad(acceleration, 0.0, step, **precise)[0], abs=error * size * step
    )
    assert travel == pytest.approx(
        quad(weighted, 0.0, step, **precise)[0], abs=error * size * step**2
    )


def test_a_circular_force_turns_and_a_directed_one_stays_on_its_line() -> None:
    circular = DIRECTIONS["circular"](0.3)
    assert (circular.vertical_sine, circular.horizontal_sine, circular.horizontal_cosine) == (
        1,
        0,
        1,
    )
    tilted = DIRECTIONS["directed"](math.radians(30.0))
    assert tilted.vertical_sine == pytest.approx(math.cos(math.radians(30.0)))
    assert tilted.horizontal_sine == pytest.approx(0.5)
    assert tilted.horizontal_cosine == 0.0


def test_a_steady_revolution() -> None:
    for plan in plans(drive(frequency_hz=28.0, amplitude_m=1.6e-3), 3):
        assert plan.frequency_hz == 28.0
        assert plan.sample_period_s == 1.0 / (28.0 * 128)
        assert plan.phase_rad == 0.0
        assert plan.phase_increment_rad == TURN / 128
        assert plan.start_acceleration == plan.end_acceleration
        assert plan.end_acceleration == pytest.approx(1.6e-3 * (TURN * 28.0) ** 2)
        assert plan.omega == pytest.approx(TURN * 28.0)
        assert not plan.changing


def test_other_numbers_of_samples() -> None:
    (plan,) = plans(drive(samples=512, frequency_hz=28.0), 1)
    assert plan.sample_period_s == 1.0 / (28.0 * 512)
    assert plan.phase_increment_rad == TURN / 512


def test_below_the_floor_the_sample_period_stays_and_the_phase_goes_slower() -> None:
    first, second, *_ = plans(drive(frequency_hz=4.0), 3)
    assert first.sample_period_s == second.sample_period_s == 1.0 / (FLOOR_HZ * 128)
    assert first.phase_increment_rad == pytest.approx(0.4 * TURN / 128)
    assert (first.phase_rad, second.phase_rad) == (0.0, pytest.approx(0.4 * TURN))


def test_a_standing_exciter_keeps_the_phase() -> None:
    exciter = drive(frequency_hz=0.0)
    for plan in plans(exciter, 2):
        assert (plan.phase_increment_rad, plan.phase_rad, plan.omega) == (0.0, 0.0, 0.0)
        assert plan.end_acceleration == 0.0
        assert plan.sample_period_s == 1.0 / (FLOOR_HZ * 128)


@pytest.mark.parametrize("rate_hz_per_s", [5.0, 10.0, 50.0])
@pytest.mark.parametrize("target_hz", [11.0, 15.0, 28.0, 40.0])
def test_run_up_takes_the_time_that_the_rate_allows(target_hz: float, rate_hz_per_s: float) -> None:
    exciter = drive(run_up=True, frequency_hz=target_hz, frequency_rate_hz_per_s=rate_hz_per_s)
    time_s = 0.0
    while exciter.frequency_hz < target_hz:
        plan = exciter.next_revolution()
        time_s += 128 * plan.sample_period_s
    # The slip that lets it meet the floor at phase zero costs no more than a revolution there.
    assert time_s == pytest.approx(target_hz / rate_hz_per_s, abs=1.0 / FLOOR_HZ)


def test_frequency_and_amplitude_go_down_at_their_rates() -> None:
    exciter = drive(frequency_hz=28.0, amplitude_m=1.6e-3)
    exciter.target_frequency_hz, exciter.target_amplitude_m = 20.0, 1.5e-3
    plan = exciter.next_revolution()
    assert plan.frequency_hz == pytest.approx(28.0 - 10.0 / 28.0)
    assert plan.amplitude_m == pytest.approx(1.6e-3 - 2e-3 / 28.0)
    assert plan.changing
    assert plan.start_acceleration == pytest.approx(1.6e-3 * (TURN * 28.0) ** 2)
    assert plan.end_acceleration == pytest.approx(
        plan.amplitude_m * (TURN * plan.frequency_hz) ** 2
    )
    last = plans(exciter, 60)[-1]
    assert (last.frequency_hz, last.amplitude_m, last.changing) == (20.0, 1.5e-3, False)


def test_without_vibration_the_exciter_stands_from_the_start() -> None:
    exciter = drive(vibrate=False, frequency_hz=28.0, amplitude_m=1.6e-3)
    assert exciter.next_revolution().frequency_hz == 0.0
    assert exciter.next_revolution().end_acceleration == 0.0
