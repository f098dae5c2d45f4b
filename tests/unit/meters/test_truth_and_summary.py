# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""True values and settled values, from the same motion by two ways."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from roller_sim_ros.meters import Mode, TruthMeter, TruthValue, kernels, summarise
from roller_sim_ros.meters.summary import blows
from roller_sim_ros.session.block import AIR, Block

N = 128
MASS, LOAD = 3200.0, 54936.0


def as_blocks(waveform: Any, size: int, hz: float = 28.0, first: int = 0) -> list[Block]:
    zero = np.zeros(size)
    return [
        Block(
            first_sample=first + start,
            time_s=start / (hz * N),
            sample_period_s=1.0 / (hz * N),
            excitation_hz=hz,
            eccentric_phase_rad=start % N * 2.0 * math.pi / N,
            phase_increment_rad=2.0 * math.pi / N,
            acceleration_vertical=waveform.vertical[start : start + size],
            acceleration_horizontal=zero,
            soil_force=waveform.force[start : start + size] * MASS,
            drum_height=zero,
            soil_displacement=zero,
            plastic_depth=zero,
            height_datum=zero,
            contact_state=waveform.state[start : start + size],
            shear_modulus_pa=50e6,
            plastic_parameter_m=0.65e-3,
        )
        for start in range(0, len(waveform.vertical), size)
    ]


def test_summary_of_a_double_jump(drum: Callable[..., Any]) -> None:
    waveform = drum(64, 2, 0.75)
    found = summarise(waveform.vertical, waveform.force * MASS, waveform.state, LOAD)
    bins = np.abs(np.fft.rfft(waveform.vertical))
    assert (found.period, found.mode, found.blows_per_period) == (2, Mode.DOUBLE_JUMP, 1)
    assert found.cmv == pytest.approx(300.0 * bins[128] / bins[64], abs=1e-9)
    assert found.rmv == pytest.approx(300.0 * bins[32] / bins[64], abs=1e-9)
    assert found.air_fraction == 0.75
    assert found.force_ratio_max == pytest.approx(waveform.force.max() * MASS / LOAD)
    assert found.acceleration_max_g == pytest.approx(waveform.vertical.max() / 9.81)
    assert found.acceleration_min_g == pytest.approx(waveform.vertical.min() / 9.81)


def test_summary_at_another_number_of_samples_per_revolution(drum: Callable[..., Any]) -> None:
    coarse = drum(64, 1, 0.5)
    fine = drum(64, 1, 0.5, count=512)
    of_coarse = summarise(coarse.vertical, coarse.force, coarse.state, 17.17)
    of_fine = summarise(fine.vertical, fine.force, fine.state, 17.17, 512)
    assert of_fine.period == of_coarse.period == 1
    # The blow is placed to half a sample.
    assert of_fine.cmv == pytest.approx(of_coarse.cmv, rel=2e-2)
    assert of_fine.air_fraction == of_coarse.air_fraction == 0.5


def test_summary_of_rest_has_no_meter_values() -> None:
    rest = np.zeros(64 * N)
    found = summarise(rest, rest + LOAD, rest.astype(np.uint8), LOAD)
    assert math.isnan(found.cmv)
    assert math.isnan(found.rmv)
    assert (found.air_fraction, found.force_ratio_max) == (0.0, 1.0)
    assert found.mode is Mode.CONTINUOUS_CONTACT
    assert found.blows_per_period == 0


def test_summary_of_a_few_revolutions_does_not_know_the_period(drum: Callable[..., Any]) -> None:
    waveform = drum(4, 4, 0.5)
    found = summarise(waveform.vertical, waveform.force, waveform.state, 17.17)
    assert found.period is None
    assert found.mode is Mode.UNKNOWN
    assert found.blows_per_period == 0


@pytest.mark.parametrize("samples", [0, 100, N + 1])
def test_summary_needs_whole_revolutions(samples: int) -> None:
    nothing = np.zeros(samples)
    with pytest.raises(ValueError, match="whole revolutions"):
        summarise(nothing, nothing, nothing.astype(np.uint8), LOAD)


@pytest.mark.parametrize(
    ("period", "air", "mode"),
    [
        (1, 0.4, Mode.PARTIAL_UPLIFT),
        (2, 0.7, Mode.DOUBLE_JUMP),
        (4, 0.8, Mode.QUAD_JUMP),
        (8, 0.9, Mode.CHAOTIC),
        (16, 0.9, Mode.CHAOTIC),
    ],
)
def test_truth_agrees_with_the_summary_whatever_the_block_size(
    drum: Callable[..., Any], period: int, air: float, mode: Mode
) -> None:
    waveform = drum(64, period, air)
    expected = summarise(waveform.vertical, waveform.force * MASS, waveform.state, LOAD)
    found = []
    for size in (1, 16, 128):
        meter = TruthMeter(64, LOAD)
        values = [meter.feed(block) for block in as_blocks(waveform, size)]
        found.append(values[-1])
        assert meter.value is values[-1]
    assert found[0] == found[1] == found[2]
    value = found[0]
    assert value.mode is expected.mode is mode
    assert value.period == (expected.period or 0)
    assert value.blows_per_period == expected.blows_per_period == (1 if period <= 8 else 0)
    assert value.air_fraction == pytest.approx(expected.air_fraction)
    assert value.force_ratio_max == pytest.approx(expected.force_ratio_max)
    assert value.cmv == pytest.approx(expected.cmv, abs=1e-9)
    assert value.last_sample == 64 * N - 1


def test_blows_are_contacts_that_begin_within_the_last_period() -> None:
    air = np.ones(4 * N, dtype=bool)
    for first in (0, N, N + 50, 2 * N, 3 * N + 100):
        air[first : first + 20] = False
    # A contact that begins with the first sample of the period counts; one that goes on does not.
    assert [blows(air, period) for period in (1, 2)] == [1, 2]
    air[2 * N - 5 : 2 * N] = False
    assert blows(air, 2) == 1
    air[-5:] = False
    assert blows(air, 1) == 2
    assert blows(air, 0) == blows(air, None) == 0


def test_rings_hold_what_the_samples_say() -> None:
    rng = np.random.default_rng(3)
    window, samples = 6, 16
    air, forces = np.zeros((window, samples), dtype=np.bool_), np.zeros(window)
    states = rng.integers(0, 3, (20, samples)).astype(np.float64)
    force = rng.normal(size=(20, samples))
    for n in range(20):
        slot = n % window
        without, greatest = kernels.note_contact(force[n], states[n], AIR, slot, air, forces)
        if n + 1 < window:
            continue
        newest = slice(n + 1 - window, n + 1)
        flat = (states[newest] == AIR).ravel()
        assert without == np.count_nonzero(flat)
        assert greatest == force[newest].max()
        for revolutions in range(1, window):
            assert kernels.contacts_begun(air, slot, revolutions) == blows(
                flat, revolutions, samples
            )


def test_a_force_that_is_no_number_is_not_hidden() -> None:
    air, forces = np.zeros((2, 4), dtype=np.bool_), np.zeros(2)
    kernels.note_contact(np.array([1.0, math.nan, 3.0, 2.0]), np.zeros(4), AIR, 0, air, forces)
    assert math.isnan(kernels.note_contact(np.ones(4), np.zeros(4), AIR, 1, air, forces)[1])


def test_truth_is_unknown_until_the_window_is_full(drum: Callable[..., Any]) -> None:
    meter = TruthMeter(16, LOAD)
    assert math.isnan(meter.value.cmv)
    values = [meter.feed(block) for block in as_blocks(drum(16, 1, 0.4), 128)]
    for index, value in enumerate(values[:-1]):
        assert value.last_sample == (index + 1) * N - 1
        assert math.isnan(value.cmv)
        assert math.isnan(value.air_fraction)
        assert math.isnan(value.force_ratio_max)
        assert value.mode is Mode.UNKNOWN
    assert values[-1].mode is Mode.PARTIAL_UPLIFT


def test_standing_roller_has_true_force_and_contact_but_no_meter_values() -> None:
    meter = TruthMeter(2, LOAD)
    value = TruthValue()
    rest = np.zeros(N)
    for revolution in range(3):
        value = meter.feed(
            Block(
                first_sample=revolution * N,
                time_s=revolution * 0.1,
                sample_period_s=0.1 / N,
                excitation_hz=0.0,
                eccentric_phase_rad=0.0,
                phase_increment_rad=0.0,
                acceleration_vertical=rest,
                acceleration_horizontal=rest,
                soil_force=rest + LOAD,
                drum_height=rest,
                soil_displacement=rest,
                plastic_depth=rest,
                height_datum=rest,
                contact_state=rest.astype(np.uint8),
                shear_modulus_pa=50e6,
                plastic_parameter_m=0.65e-3,
            )
        )
    assert (value.air_fraction, value.force_ratio_max) == (0.0, 1.0)
    assert math.isnan(value.cmv)
    assert value.mode is Mode.UNKNOWN


def test_frequency_change_hides_period_and_mode(drum: Callable[..., Any]) -> None:
    waveform = drum(8, 1, 0.4)
    meter = TruthMeter(4, LOAD)
    for block in as_blocks(waveform, 128):
        meter.feed(block)
    assert meter.value.mode is Mode.PARTIAL_UPLIFT
    modes = [meter.feed(block).mode for block in as_blocks(waveform, 128, hz=30.0, first=8 * N)]
    assert modes == [Mode.UNKNOWN] * 3 + [Mode.PARTIAL_UPLIFT] * 5


def test_missing_samples_begin_a_new_window(drum: Callable[..., Any]) -> None:
    blocks = as_blocks(drum(8, 1, 0.4), 128)
    meter = TruthMeter(2, LOAD)
    known = [math.isfinite(meter.feed(block).cmv) for block in blocks[:3] + blocks[4:]]
    assert known == [False, True, True, False, True, True, True]
