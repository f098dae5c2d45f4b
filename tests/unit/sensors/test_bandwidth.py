# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The analogue low-pass, at a sample period that changes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from roller_sim_ros.sensors.bandwidth import LowPass
from roller_sim_ros.sensors.second_order import noise_step, variance
from roller_sim_ros.sensors.stage import Signals


def through(bandwidth_hz: float, pieces: list[tuple[np.ndarray, float]]) -> np.ndarray:
    low_pass = LowPass(bandwidth_hz)
    out = [low_pass.apply(Signals(piece, 2.0 * piece, period)) for piece, period in pieces]
    for signals in out:
        assert signals.horizontal == pytest.approx(2.0 * signals.vertical, abs=1e-9)
    return np.concatenate([signals.vertical for signals in out])


@pytest.mark.parametrize("ratio", [0.1, 1.0, 3.0])
def test_gain_and_phase_are_those_of_a_butterworth_of_second_order(ratio: float) -> None:
    hz, bandwidth_hz, period_s = 40.0, 40.0 / ratio, 1.0 / 5000.0
    count = 5000 * 2
    time_s = period_s * np.arange(count)
    out = through(bandwidth_hz, [(np.sin(2.0 * np.pi * hz * time_s), period_s)])
    tail = slice(count // 2, count)
    found = 2.0 * np.mean(out[tail] * np.exp(-2j * np.pi * hz * time_s[tail])) * 1j
    s = 1j * ratio
    expected = 1.0 / (s * s + math.sqrt(2.0) * s + 1.0)
    # A straight line between samples has a gain of sinc², here 1 − 2e-4.
    assert abs(found - expected) < 4e-4 * abs(expected)
    if ratio == 1.0:
        assert abs(found) == pytest.approx(math.sqrt(0.5), rel=4e-4)


def test_a_changing_sample_period_is_exact_for_straight_lines() -> None:
    random = np.random.default_rng(5)
    periods_s = [1e-3, 0.7e-3, 1.9e-3]
    pieces = [(random.normal(size=6), period_s) for period_s in periods_s]
    out = through(150.0, pieces)
    values = np.concatenate([piece for piece, _ in pieces])
    steps_s = np.concatenate([np.full(6, period_s) for period_s in periods_s])[:-1]
    times_s = np.concatenate([[0.0], np.cumsum(steps_s)])
    omega = 2.0 * math.pi * 150.0

    def slope(time_s: float, state: np.ndarray) -> list[float]:
        u = np.interp(time_s, times_s, values)
        return [state[1], omega**2 * (u - state[0]) - math.sqrt(2.0) * omega * state[1]]

    state = np.array([values[0], 0.0])
    for index in range(1, len(times_s)):
        span = (times_s[index - 1], times_s[index])
        state = solve_ivp(slope, span, state, rtol=1e-10, atol=1e-12).y[:, -1]
        assert out[index] == pytest.approx(state[0], abs=1e-8)


def test_it_is_settled_at_the_start() -> None:
    assert through(100.0, [(np.full(50, 9.81), 2e-4)]) == pytest.approx(9.81, abs=1e-12)


@pytest.mark.parametrize("bandwidth_hz", [1.0, 800.0, 11e3, 1e6])
def test_noise_steps_keep_the_stationary_variance(bandwidth_hz: float) -> None:
    matrix, factor = noise_step(bandwidth_hz, 1.0 / 3584.0)
    stationary = variance(bandwidth_hz) * np.eye(2)
    after = matrix @ stationary @ matrix.T + factor @ factor.T
    assert after == pytest.approx(stationary, rel=1e-9, abs=1e-9 * stationary[0, 0])
    # The noise bandwidth of a Butterworth of second order is π/(2 √2) of its bandwidth.
    assert variance(bandwidth_hz) == pytest.approx(bandwidth_hz * math.pi / (2.0 * math.sqrt(2.0)))
