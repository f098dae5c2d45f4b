# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Latency: found where the true value tells it, and a reason where it does not."""

from __future__ import annotations

import math

import numpy as np
import pytest

from roller_sim_ros.score.latency import find_latency

PERIOD_S = 1.0 / 28.0


def ground(revolutions: int = 800) -> np.ndarray:
    """A true value that goes up and down as ground does."""
    random = np.random.default_rng(1)
    steps = np.convolve(random.standard_normal(revolutions + 15), np.ones(16) / 16.0, "valid")
    return 40.0 + 8.0 * steps


@pytest.mark.parametrize("lag", [-2, 0, 1, 14, 60])
def test_a_shift_is_found(lag: int) -> None:
    true = ground()
    late = np.roll(true, lag)
    late[: max(lag, 0)] = np.nan
    late[400:420] = np.nan
    found = find_latency(1.2 * late + 3.0, true, PERIOD_S, 3.0)
    assert found.revolutions == lag
    assert found.seconds == pytest.approx(lag * PERIOD_S, abs=0.02 * PERIOD_S)


def test_a_window_is_late_by_half_of_its_length() -> None:
    true = ground(2000)
    averaged = np.convolve(true, np.ones(9) / 9.0)[: len(true)]
    averaged[:8] = np.nan
    found = find_latency(averaged, true, PERIOD_S, 3.0)
    assert found.seconds == pytest.approx(4 * PERIOD_S, abs=0.5 * PERIOD_S)


@pytest.mark.parametrize(
    ("value", "true", "reason"),
    [
        (np.full(800, 40.0), np.full(800, 40.0), "hardly changes"),
        (np.random.default_rng(3).standard_normal(800), ground(), "do not go with"),
        (np.linspace(20.0, 60.0, 800), np.linspace(20.0, 60.0, 800), "too slowly"),
        (ground(40), ground(40), "fewer than 64"),
    ],
)
def test_where_nothing_can_be_told_the_reason_is(
    value: np.ndarray, true: np.ndarray, reason: str
) -> None:
    found = find_latency(value, true, PERIOD_S, 3.0)
    assert math.isnan(found.seconds)
    assert found.revolutions == 0
    assert reason in found.reason


def test_a_lag_beyond_those_looked_for_is_no_small_one() -> None:
    true = np.repeat(ground(80), 40)
    found = find_latency(np.roll(true, 100), true, PERIOD_S, 2.0)
    assert not found.seconds < 1.9
