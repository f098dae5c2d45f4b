# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The period: found where it is, to the tolerance, and unknown rather than wrong."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.meters.period import NO_PERIOD, PeriodWindow, period

N = 128


def repeating(revolutions: int, every: int, seed: int = 0) -> np.ndarray:
    unit = np.random.default_rng(seed).normal(size=every * N)
    return np.tile(unit, revolutions // every + 1)[: revolutions * N]


@pytest.mark.parametrize("every", [1, 2, 4, 8])
def test_period_is_the_smallest_number_of_revolutions(every: int) -> None:
    assert period(repeating(64, every)) == every
    assert period(repeating(16, every)) == every


@pytest.mark.parametrize("every", [3, 5, 16, 64])
def test_other_repetitions_are_none(every: int) -> None:
    assert period(repeating(64, every)) == NO_PERIOD


def test_tolerance_is_one_percent_of_the_peak() -> None:
    samples = repeating(16, 1)
    peak = np.max(np.abs(samples))
    for share, found in ((0.0099, 1), (0.0101, NO_PERIOD)):
        disturbed = samples.copy()
        # A sample of middling size in one revolution only.
        where = int(np.argmin(np.abs(samples[:N] - 0.3))) + 5 * N
        disturbed[where] += share * peak
        assert period(disturbed) == found


@pytest.mark.parametrize(("revolutions", "longest"), [(2, 1), (4, 2), (8, 4), (14, 4), (16, 8)])
def test_a_window_tells_periods_up_to_half_of_it_and_none_only_from_16(
    revolutions: int, longest: int
) -> None:
    assert period(repeating(revolutions, longest)) == longest
    other = period(np.random.default_rng(3).normal(size=revolutions * N))
    assert other == (NO_PERIOD if revolutions >= 16 else None)


@settings(max_examples=40, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    every=st.sampled_from([1, 2, 4, 8, 16]),
    window=st.sampled_from([2, 6, 16, 20]),
    slip=st.floats(-0.02, 0.02),
)
def test_stream_equals_batch(seed: int, every: int, window: int, slip: float) -> None:
    samples = repeating(window + 9, every, seed)
    samples[(window + 3) * N + 11] += slip
    stream = PeriodWindow(window)
    for index in range(window + 9):
        stream.push(samples[index * N : (index + 1) * N])
        if index + 1 < window:
            assert stream.period() is None
            continue
        batch = samples[(index + 1 - window) * N : (index + 1) * N]
        assert stream.period() == period(batch - batch.mean())


def test_gravity_and_bias_change_nothing(drum: Callable[..., Any]) -> None:
    revolutions = drum(16, 1, 0.4).vertical.reshape(16, N)
    # Every other revolution differs by a little more than the tolerance: a bias must not raise the peak.
    revolutions[::2, 5] += 0.012 * np.abs(revolutions).max()
    found = []
    for offset in (0.0, 9.81, -300.0):
        stream = PeriodWindow(16)
        for revolution in revolutions + offset:
            stream.push(revolution)
        found.append(stream.period())
    assert found == [2, 2, 2]


def test_a_wider_tolerance_takes_a_slow_change_for_a_repetition(drum: Callable[..., Any]) -> None:
    # A motion of period 2 that grows by 1.5 % from one pair of revolutions to the next, as over a changing ground.
    revolutions = drum(16, 2, 0.4).vertical.reshape(16, N)
    growing = revolutions * np.repeat(1.015 ** np.arange(8), 2)[:, None]
    found = []
    for tolerance in (0.01, 0.05):
        stream = PeriodWindow(16, tolerance=tolerance)
        for revolution in growing:
            stream.push(revolution)
        found.append(stream.period())
    assert found == [NO_PERIOD, 2]


def test_repetitions_are_rows_of_a_period_oldest_first() -> None:
    stream = PeriodWindow(6)
    for index in range(9):
        stream.push(np.full(N, float(index)))
    assert stream.repetitions(2)[:, ::N].tolist() == [[3, 4], [5, 6], [7, 8]]
    assert stream.repetitions(NO_PERIOD)[:, ::N].tolist() == [[3, 4, 5], [6, 7, 8]]
