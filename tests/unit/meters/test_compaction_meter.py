# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The meter: the same numbers for every client, and a reason wherever there is no number."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.meters import CompactionMeter, MeterValue, Mode, Status
from roller_sim_ros.meters.registry import METERS, evaluate

N = 128
STEP = 2.0 * math.pi / N
PERIOD_S = 1.0 / (28.0 * N)


def blocks(
    samples: np.ndarray, cuts: Iterable[int] = (), first: int = 0, size: int = 16
) -> list[tuple[int, np.ndarray]]:
    """Cut samples into blocks, at `cuts` or every `size`."""
    edges = sorted({0, len(samples), *(cuts or range(0, len(samples), size))})
    return [
        (first + start, samples[start:end].astype(np.float32))
        for start, end in itertools.pairwise(edges)
    ]


def feed(
    meter: CompactionMeter, pieces: Iterable[tuple[int, np.ndarray]], hz: float = 28.0
) -> list[MeterValue]:
    values = []
    for first, samples in pieces:
        phase = first % N * STEP
        values += meter.feed(first, samples, 1.0 / (hz * N), hz, phase, STEP)
    return values


def exactly(values: list[MeterValue]) -> list[str]:
    """Values as text that shows every bit, also NaN."""
    return [repr(replace(value, mode=Mode(value.mode))) for value in values]


def test_values_are_those_of_the_definition(drum: Callable[..., Any]) -> None:
    samples = drum(32, 2, 0.7).vertical
    value = feed(CompactionMeter(), blocks(samples))[-1]
    bins = np.abs(np.fft.rfft(samples[16 * N :]))
    assert value.cmv == pytest.approx(300.0 * bins[32] / bins[16], rel=1e-6)
    assert value.rmv == pytest.approx(300.0 * bins[8] / bins[16], rel=1e-6)
    assert value.fundamental_amplitude == pytest.approx(bins[16] / (8.0 * N), rel=1e-6)
    assert value.rmv > 50.0
    assert (value.period, value.mode, value.status) == (2, Mode.DOUBLE_JUMP, Status.NONE)
    assert (value.last_sample, value.window_revolutions) == (32 * N - 1, 16)


def test_phase_is_that_of_the_acceleration_against_sin_of_the_eccentric() -> None:
    phase = np.arange(32 * N) * STEP
    free = feed(CompactionMeter(), blocks(50.0 * np.sin(phase)))[-1]
    lagging = feed(CompactionMeter(), blocks(50.0 * np.sin(phase - 0.7)))[-1]
    assert free.fundamental_phase == pytest.approx(0.0, abs=1e-7)
    assert lagging.fundamental_phase == pytest.approx(-0.7, abs=1e-7)


@settings(max_examples=40, deadline=None)
@given(data=st.data(), seed=st.integers(0, 1000))
def test_block_size_does_not_change_a_bit(data: st.DataObject, seed: int) -> None:
    samples = np.random.default_rng(seed).normal(size=20 * N) * 40.0
    cuts = data.draw(st.lists(st.integers(0, len(samples)), max_size=40))
    whole = feed(CompactionMeter(4), blocks(samples, size=len(samples)))
    pieces = feed(CompactionMeter(4), blocks(samples, cuts=[0, *cuts]))
    assert len(whole) == 20
    assert exactly(pieces) == exactly(whole)


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 1000),
    lost=st.lists(st.integers(0, 159), max_size=6),
    doubled=st.lists(st.integers(0, 159), max_size=6),
)
def test_lost_and_repeated_blocks_cost_their_window_and_nothing_else(
    seed: int, lost: list[int], doubled: list[int]
) -> None:
    samples = np.random.default_rng(seed).normal(size=20 * N) * 40.0
    pieces = blocks(samples)
    received = [
        piece
        for index, piece in enumerate(pieces)
        if index not in lost
        for _ in range(2 if index in doubled else 1)
    ]
    complete = {value.last_sample: value for value in feed(CompactionMeter(4), pieces)}
    found = {value.last_sample: value for value in feed(CompactionMeter(4), received)}
    holes = {index * 16 // N for index in lost}
    assert set(found) == {(rev + 1) * N - 1 for rev in range(20) if rev not in holes}
    for last, value in found.items():
        revolution = last // N
        if all(rev not in holes for rev in range(max(0, revolution - 3), revolution + 1)):
            assert exactly([replace(value, status=Status.NONE)]) == exactly(
                [replace(complete[last], status=Status.NONE)]
            )
        else:
            assert math.isnan(value.cmv)
            # What is lost before the first sample that arrived is not missed.
            before = [hole for hole in holes if min(found) // N < hole < revolution]
            assert (Status.GAP in value.status) >= bool(before)


def test_window_filling() -> None:
    values = feed(CompactionMeter(4), blocks(np.sin(np.arange(6 * N) * STEP)))
    assert [value.status for value in values] == [Status.WINDOW_FILLING] * 3 + [Status.NONE] * 3
    for value in values[:3]:
        assert math.isnan(value.cmv)
        assert math.isnan(value.rmv)
        assert math.isnan(value.fundamental_amplitude)
        assert (value.period, value.mode) == (0, Mode.UNKNOWN)
    assert values[0].excitation_frequency == 28.0


def test_gap_begins_a_new_window_and_is_said_until_it_is_full() -> None:
    samples = np.sin(np.arange(12 * N) * STEP)
    pieces = blocks(samples)
    del pieces[5 * 8 + 3]
    values = feed(CompactionMeter(4), pieces)
    by_revolution = {value.last_sample // N: value.status for value in values}
    assert 5 not in by_revolution
    gap = Status.GAP | Status.WINDOW_FILLING
    assert [by_revolution[rev] for rev in (4, 6, 7, 8, 9, 10)] == [0, gap, gap, gap, 0, 0]


def test_gap_is_forgotten_once_a_window_was_full() -> None:
    meter = CompactionMeter(2)
    wave = np.sin(np.arange(N) * STEP)
    feed(meter, blocks(wave))
    values = [feed(meter, blocks(wave, first=rev * N))[-1].status for rev in (2, 3)]
    assert values == [Status.GAP | Status.WINDOW_FILLING, Status.NONE]
    (standing,) = meter.feed(4 * N, np.zeros(N, np.float32), 1e-3, 0.0, 0.0, 0.0)
    assert standing.status is Status.STANDING


def test_late_block_does_not_heal_a_gap_that_was_passed() -> None:
    pieces = blocks(np.sin(np.arange(12 * N) * STEP))
    late = pieces.pop(43)
    pieces.insert(44, late)
    swapped = feed(CompactionMeter(4), pieces)
    assert 5 * N + N - 1 not in {value.last_sample for value in swapped}
    assert swapped[-1].status is Status.NONE


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_samples_that_are_no_numbers_are_a_gap(value: float) -> None:
    samples = np.sin(np.arange(12 * N) * STEP)
    samples[5 * N + 7] = value
    values = feed(CompactionMeter(4), blocks(samples))
    gap = Status.GAP | Status.WINDOW_FILLING
    assert [found.status for found in values[4:]] == [0, gap, gap, gap, gap, 0, 0, 0]
    assert [math.isnan(found.cmv) for found in values[4:9]] == [False, True, True, True, True]
    assert values[-1].cmv == pytest.approx(0.0, abs=1e-4)


def test_blocks_without_samples_are_nothing() -> None:
    meter = CompactionMeter(2)
    empty = np.zeros(0, dtype=np.float32)
    assert feed(meter, [(5000, empty)]) == []
    values = feed(meter, [*blocks(np.sin(np.arange(2 * N) * STEP)), (9 * N, empty)])
    assert values[-1].status is Status.NONE
    assert feed(meter, blocks(np.sin(np.arange(N) * STEP), first=2 * N))[0].status is Status.NONE


def test_restarted_sender_is_followed_at_once() -> None:
    meter = CompactionMeter(4)
    samples = np.sin(np.arange(8 * N) * STEP)
    feed(meter, blocks(samples, first=1000 * N))
    values = feed(meter, blocks(samples))
    assert [value.last_sample // N for value in values] == list(range(8))
    assert Status.GAP in values[0].status
    assert values[-1].status is Status.NONE


def test_client_that_joins_late_gets_the_same_values(drum: Callable[..., Any]) -> None:
    samples = drum(40, 2, 0.6).vertical
    everything = feed(CompactionMeter(), blocks(samples))
    joined = feed(CompactionMeter(), blocks(samples[N * 3 + 48 :], first=N * 3 + 48))
    assert joined[0].last_sample == 5 * N - 1
    assert joined[0].status is Status.WINDOW_FILLING
    known = {value.last_sample: value for value in everything}
    late = [value for value in joined if value.status is Status.NONE]
    assert len(late) == 40 - 4 - 15
    assert exactly(late) == exactly([known[value.last_sample] for value in late])


def test_standing_roller_has_no_values_but_says_so() -> None:
    meter = CompactionMeter(2)
    values = []
    for first in range(0, 4 * N, 16):
        values += meter.feed(first, np.zeros(16, np.float32), 1e-3, 0.0, 0.0, 0.0)
    assert [value.last_sample for value in values] == [N - 1, 2 * N - 1, 3 * N - 1, 4 * N - 1]
    assert {value.status for value in values} == {Status.STANDING}
    assert all(math.isnan(value.cmv) and math.isnan(value.rmv) for value in values)
    assert all(value.mode is Mode.UNKNOWN for value in values)


def test_below_the_sampling_floor_there_are_no_revolutions() -> None:
    meter = CompactionMeter(2)
    floor = 1.0 / (10.0 * N)
    values = []
    for first in range(0, 3 * N, 16):
        phase = first * STEP * 0.7 % (2 * math.pi)
        samples = np.sin(phase + np.arange(16) * STEP * 0.7).astype(np.float32)
        values += meter.feed(first, samples, floor, 7.0, phase, 0.7 * STEP)
    assert [value.status for value in values] == [Status.WINDOW_FILLING] * 3
    assert {value.excitation_frequency for value in values} == {7.0}


def test_frequency_change_is_said_while_it_is_in_the_window() -> None:
    meter = CompactionMeter(4)
    samples = np.sin(np.arange(N) * STEP)
    statuses = []
    for revolution, hz in enumerate([28.0] * 6 + [29.0] * 6):
        (value,) = feed(meter, blocks(samples, first=revolution * N), hz)
        statuses.append(value.status)
        assert value.excitation_frequency == hz
        if Status.FREQUENCY_CHANGING in value.status:
            assert math.isfinite(value.cmv)
            assert (value.period, value.mode) == (0, Mode.UNKNOWN)
    assert statuses[3:] == [0, 0, 0] + [Status.FREQUENCY_CHANGING] * 3 + [0, 0, 0]


@pytest.mark.parametrize("size", [16, 48, 128])
def test_clipped_samples_are_said_while_they_are_in_the_window(size: int) -> None:
    samples = np.tile(np.sin(np.arange(N) * STEP), 10)
    meter, statuses = CompactionMeter(4), []
    for first, piece in blocks(samples, size=size):
        # One sample in the middle of the revolution before the last of the first window.
        clipped = int(first <= 2 * N + 60 < first + len(piece))
        values = meter.feed(first, piece, PERIOD_S, 28.0, first % N * STEP, STEP, clipped=clipped)
        statuses += [value.status for value in values]
        assert all(math.isfinite(value.cmv) for value in values if value.last_sample >= 4 * N - 1)
    assert statuses[3:] == [Status.CLIPPED] * 3 + [Status.NONE] * 4


def test_a_stream_that_begins_anew_has_no_part_in_what_was_clipped_before() -> None:
    samples = np.tile(np.sin(np.arange(N) * STEP), 4)
    meter = CompactionMeter(2)
    for first, piece in blocks(samples, first=40 * N):
        meter.feed(first, piece, PERIOD_S, 28.0, first % N * STEP, STEP, clipped=1)
    assert feed(meter, blocks(samples))[-1].status is Status.NONE


def test_below_the_noise_floor_the_amplitude_is_known_and_the_rest_is_not() -> None:
    quiet = 0.04 * np.sin(np.arange(4 * N) * STEP)
    value = feed(CompactionMeter(4, 0.05), blocks(quiet))[-1]
    assert value.status is Status.BELOW_NOISE
    assert value.fundamental_amplitude == pytest.approx(0.04, rel=1e-6)
    assert math.isnan(value.cmv)
    assert math.isnan(value.rmv)
    assert math.isnan(value.fundamental_phase)
    assert value.mode is Mode.UNKNOWN
    assert feed(CompactionMeter(4, 0.03), blocks(quiet))[-1].status is Status.NONE


def test_silence_is_below_any_noise_floor() -> None:
    value = feed(CompactionMeter(2, 0.0), blocks(np.zeros(4 * N)))[-1]
    assert value.status is Status.BELOW_NOISE
    assert math.isnan(value.cmv)


def test_specific_force_gives_the_values_of_coordinate_acceleration(
    drum: Callable[..., Any],
) -> None:
    samples = drum(20, 1, 0.4).vertical
    plain = feed(CompactionMeter(), blocks(samples))[-1]
    with_gravity = feed(CompactionMeter(), blocks(samples + 9.81))[-1]
    assert with_gravity.cmv == pytest.approx(plain.cmv, rel=1e-6)
    assert with_gravity.period == plain.period == 1
    assert with_gravity.mode is plain.mode is Mode.PARTIAL_UPLIFT


def test_rounding_of_the_senders_phase_does_not_reach_the_values(drum: Callable[..., Any]) -> None:
    samples = drum(20, 1, 0.4).vertical.astype(np.float32)
    found = []
    for rounding in (0.0, 1e-13, -1e-13):
        meter, values = CompactionMeter(), []
        for first in range(0, len(samples), 16):
            phase = (first * STEP + rounding) % (2 * math.pi)
            values += meter.feed(first, samples[first : first + 16], PERIOD_S, 28.0, phase, STEP)
        found.append(exactly(values))
    assert found[0] == found[1] == found[2]


@pytest.mark.parametrize("revolutions", [0, 3, -2])
def test_window_must_be_even(revolutions: int) -> None:
    with pytest.raises(ValueError, match="positive even number"):
        CompactionMeter(revolutions)


def test_every_meter_states_its_source() -> None:
    assert [meter.name for meter in METERS] == ["cmv", "rmv", "ccv"]
    for meter in METERS:
        assert len(meter.source) > 20
        assert meter.verified is False
        assert meter.unit == ""
        assert meter.orders


def test_meter_values_of_known_amplitudes() -> None:
    from roller_sim_ros.meters.harmonics import Harmonics

    amplitudes = np.array([3.0j, -20.0, 1.0, 5.0 + 0.0j, -0.5j, 2.0])
    harmonics = Harmonics((0.5, 1.0, 1.5, 2.0, 2.5, 3.0), amplitudes)
    assert evaluate(harmonics) == {
        "cmv": pytest.approx(75.0),
        "rmv": pytest.approx(45.0),
        "ccv": pytest.approx(100.0 * (3.0 + 1.0 + 5.0 + 0.5 + 2.0) / 23.0),
    }
