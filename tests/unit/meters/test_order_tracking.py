# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Samples of a fixed rate give the values that samples of the eccentric's angle give."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np
import pytest

from roller_sim_ros.meters import CompactionMeter, MeterValue, Status

TURN = 2.0 * math.pi
RATE_HZ = 4000.0
Block = tuple[int, np.ndarray, float, float, float]


def motion(turns: np.ndarray) -> np.ndarray:
    """A double jump: half orders too; `turns` of the eccentric."""
    angle = TURN * turns
    return (
        40.0 * np.sin(angle - 0.4)
        + 9.0 * np.sin(0.5 * angle)
        + 6.0 * np.sin(1.5 * angle + 1.0)
        + 7.0 * np.sin(2.0 * angle + 2.0)
        + 3.0 * np.sin(5.0 * angle)
    )


CMV, RMV = 300.0 * 7.0 / 40.0, 300.0 * 9.0 / 40.0


def blocks(frequencies: list[float], size: int = 10_000, skew: float = 0.0) -> Iterator[Block]:
    """Yield (first sample, samples, frequency, phase, increment) as a sensor sends them: cut where revolutions end."""
    begins = np.concatenate([[0.0], np.cumsum(1.0 / np.array(frequencies))])
    for number, hz in enumerate(frequencies):
        first, end = (math.ceil(begins[number + step] * RATE_HZ - 1e-9) for step in (0, 1))
        for start in range(first, end, size):
            samples = np.arange(start, min(end, start + size))
            turns = (samples / RATE_HZ - begins[number]) * hz
            step = TURN * hz / RATE_HZ * (1.0 + skew)
            yield start, motion(number + turns), hz, TURN * turns[0], step


def feed(
    meter: CompactionMeter, pieces: Iterator[Block] | list[Block], **more: int
) -> list[MeterValue]:
    values = []
    for first, samples, hz, phase, increment in pieces:
        values += meter.feed(
            first, samples.astype(np.float32), 1.0 / RATE_HZ, hz, phase, increment, **more
        )
    return values


def test_values_are_those_of_the_motion() -> None:
    values = feed(CompactionMeter(), blocks([28.0] * 40))
    # The first revolution has nothing before it to interpolate from, the last nothing after it.
    assert [value.status for value in values[:15]] == [Status.WINDOW_FILLING] * 15
    assert len(values) == 38
    for value in values[15:]:
        assert value.status is Status.NONE
        assert value.cmv == pytest.approx(CMV, rel=1e-4)
        assert value.rmv == pytest.approx(RMV, rel=1e-4)
        assert value.fundamental_phase == pytest.approx(-0.4, abs=1e-4)
        assert value.period == 2
    ends = [math.ceil(RATE_HZ * (number + 1) / 28.0) - 1 for number in range(1, 39)]
    assert [value.last_sample for value in values] == ends


@pytest.mark.parametrize("size", [1, 7, 100])
def test_the_same_bits_whatever_the_blocks(size: int) -> None:
    # Where a revolution's first block begins does not depend on the size.
    whole = feed(CompactionMeter(), blocks([27.3] * 30))
    assert [repr(it) for it in feed(CompactionMeter(), blocks([27.3] * 30, size))] == [
        repr(it) for it in whole
    ]


@pytest.mark.parametrize("skew", [-5e-4, 5e-4])
@pytest.mark.parametrize("size", [3, 10_000])
def test_a_clock_that_runs_off_loses_no_revolution(skew: float, size: int) -> None:
    values = feed(CompactionMeter(), blocks([28.0] * 60, size, skew))
    assert len(values) >= 57
    assert {value.status for value in values[15:]} == {Status.NONE}
    for value in values[15:]:
        assert value.cmv == pytest.approx(CMV, rel=1e-2)


def test_a_changing_frequency_is_followed_and_said() -> None:
    frequencies = [28.0] * 20 + [28.1, 28.2, 28.3] + [28.3] * 20
    values = feed(CompactionMeter(), blocks(frequencies))
    assert values[15].status is Status.NONE
    changing = [value for value in values if Status.FREQUENCY_CHANGING in value.status]
    assert len(changing) == 15 + 2
    for value in changing:
        assert value.cmv == pytest.approx(CMV, rel=1e-2)
    assert values[-1].status is Status.NONE


def test_a_gap_begins_the_window_anew_and_what_comes_late_or_twice_does_not_matter() -> None:
    pieces = list(blocks([28.0] * 70, 64))
    values = feed(CompactionMeter(), [*pieces[:60], *pieces[61:]])
    gap = [value.status for value in values].index(Status.WINDOW_FILLING | Status.GAP)
    assert {value.status for value in values[15:gap]} == {Status.NONE}
    assert {value.status for value in values[gap : gap + 15]} == {
        Status.WINDOW_FILLING | Status.GAP
    }
    assert values[gap + 15].status is Status.NONE
    assert values[gap + 15].rmv == pytest.approx(RMV, rel=1e-4)
    twice = list(itertools.chain.from_iterable((piece, piece) for piece in pieces))
    assert [repr(it) for it in feed(CompactionMeter(), twice)] == [
        repr(it) for it in feed(CompactionMeter(), pieces)
    ]


def test_clipped_samples_are_said() -> None:
    meter = CompactionMeter()
    pieces = list(blocks([28.0] * 60))
    values = feed(meter, pieces[:30])
    values += feed(meter, pieces[30:31], clipped=1)
    values += feed(meter, pieces[31:])
    clipped = [index for index, value in enumerate(values) if value.status is Status.CLIPPED]
    # Number 30 is the 29th that comes out; 16 windows hold it.
    assert clipped == list(range(29, 45))


def test_slow_turning_and_standing_have_no_value() -> None:
    meter = CompactionMeter(2)
    slow = feed(meter, blocks([8.0] * 6))
    assert {value.status for value in slow} == {Status.WINDOW_FILLING}
    standing = meter.feed(10_000, np.zeros(400, np.float32), 1.0 / RATE_HZ, 0.0, 0.0, 0.0)
    assert len(standing) == 2
    assert all(Status.STANDING in value.status for value in standing)
    assert all(math.isnan(value.cmv) for value in standing)


def test_samples_of_the_angle_are_read_as_before_after_samples_of_a_fixed_rate() -> None:
    meter = CompactionMeter(2)
    feed(meter, blocks([28.0] * 10))
    turns = np.arange(6 * 128) / 128.0
    fresh, used = (
        it.feed(0, motion(turns).astype(np.float32), 1.0 / (28.0 * 128), 28.0, 0.0, TURN / 128)
        for it in (CompactionMeter(2), meter)
    )
    assert [repr(value) for value in used] == [repr(value) for value in fresh]
